// Sphere; a point if the radius is 0.
#pragma once

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// h(n) = radius. A sphere of radius 0 is a point. So the distance of a point from a body is a query of two bodies.
class SUPERNORMAL_API Sphere final : public Shape {
 public:
  /// `radius` in m, in [0, 1e30]; std::invalid_argument otherwise.
  explicit Sphere(double radius);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override { return {.has_hessian = true, .is_symmetric = true, .is_round = true}; }
  bool surely_contains(const Vector3& point) const override;
  /// "radius".
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  Vector3 half_extents() const override { return Vector3::Constant(radius_); }
  double bounding_radius() const override { return half_extents().maxCoeff(); }
  double min_curvature_radius_estimate() const override;
  double rolling_radius() const override { return radius_; }
  MassProperties mass_properties() const override;

  double radius() const { return radius_; }  ///< m

 private:
  double radius_;
};

}  // namespace supernormal
