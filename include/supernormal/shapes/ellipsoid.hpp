// Ellipsoid: its support function is a Euclidean norm and needs no powers.
#pragma once

#include "supernormal/shapes/lane_body.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// (x/a)^2 + (y/b)^2 + (z/c)^2 = 1 in the body's frame; h(n) = |(a nx, b ny, c nz)|.
class SUPERNORMAL_API Ellipsoid final : public Shape {
 public:
  /// Half-axes in m, finite and in [1e-30, 1e30]; std::invalid_argument otherwise.
  explicit Ellipsoid(const Vector3& half_axes);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override { return {.has_hessian = true, .is_symmetric = true, .is_round = true}; }
  bool surely_contains(const Vector3& point) const override;
  /// The half-axes "a", "b" and "c".
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  Vector3 half_extents() const override { return half_axes_; }
  double bounding_radius() const override { return half_extents().maxCoeff(); }

  /// The smallest radius of curvature: c^2/a with the smallest half-axis c and the largest a.
  double rolling_radius() const override;
  MassProperties mass_properties() const override;

  const Vector3& half_axes() const { return half_axes_; }  ///< m; along the axes of its frame

 private:
  friend class LaneBodies;

  Vector3 half_axes_;
  Vector3 squares_;  // m^2; half_axes_ squared
  LaneBody numbers_;
};

}  // namespace supernormal
