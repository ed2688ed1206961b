// Any shape swept by a sphere.
#pragma once

#include <memory>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The Minkowski sum of a shape and a sphere: h + radius, r + radius n; every radius of curvature grows by `radius`.
class SUPERNORMAL_API Rounded final : public Shape {
 public:
  /// `core` must not be null; radius in m, in [0, 1e30]; std::invalid_argument otherwise.
  Rounded(std::shared_ptr<const Shape> core, double radius);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  bool has_curvature() const override { return core_->has_curvature(); }
  Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const override;
  bool has_flat_faces() const override { return core_->has_flat_faces(); }
  Vector3 half_extents() const override;
  SharpFeatures sharp_features() const override;
  MassProperties mass_properties() const override;

  const Shape& core() const { return *core_; }
  double radius() const { return radius_; }

 private:
  std::shared_ptr<const Shape> core_;
  double radius_;
};

}  // namespace supernormal
