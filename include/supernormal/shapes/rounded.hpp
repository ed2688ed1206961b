// A shape swept by a sphere.
#pragma once

#include <memory>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The Minkowski sum of a shape and a sphere: h + radius, r + radius n. Every radius of curvature increases by `radius`.
class SUPERNORMAL_API Rounded final : public Shape {
 public:
  /// `core` must not be null; `radius` in m, in [0, 1e30]; std::invalid_argument otherwise.
  Rounded(std::shared_ptr<const Shape> core, double radius);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override;
  Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const override;
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const override;
  bool crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const override;
  bool surely_contains(const Vector3& point) const override;
  /// The parameters of the core, and "radius".
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  Vector3 half_extents() const override;
  double min_curvature_radius_estimate() const override;
  double bounding_radius() const override { return core_->bounding_radius() + radius_; }
  double rolling_radius() const override { return core_->rolling_radius() + radius_; }

  /// Accurate to 1e-11 for all shapes of the library but sums and linear images, swept once or repeatedly. Other shapes use
  /// Shape::mass_properties(), which does not see flat faces: see relative_error there.
  MassProperties mass_properties() const override;

  const Shape& core() const { return *core_; }  ///< the shape without the rounding
  double radius() const { return radius_; }     ///< m

 private:
  std::shared_ptr<const Shape> core_;
  double radius_;
};

}  // namespace supernormal
