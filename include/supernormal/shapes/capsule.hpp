// Capsule: a segment swept by a sphere.
#pragma once

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The points within `radius` of the segment from (0, 0, -half_length) to (0, 0, half_length): h(n) = half_length |nz| + radius.
/// For a normal of the side, r(n) is at one of the two ends.
class SUPERNORMAL_API Capsule final : public Shape {
 public:
  /// Both in m, in [0, 1e30]; std::invalid_argument otherwise. With a radius of 0 it is a segment.
  Capsule(double radius, double half_length);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override {
    return {.has_hessian = true, .is_symmetric = true, .has_nonsmooth_points = half_length_ > 0};
  }
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const override;
  bool surely_contains(const Vector3& point) const override;
  /// "radius" and "half_length".
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  Vector3 half_extents() const override { return {radius_, radius_, half_length_ + radius_}; }
  double bounding_radius() const override { return half_extents().maxCoeff(); }
  double min_curvature_radius_estimate() const override;
  double rolling_radius() const override { return radius_; }
  MassProperties mass_properties() const override;

  double radius() const { return radius_; }            ///< m
  double half_length() const { return half_length_; }  ///< m; from the centre to the centre of a cap

 private:
  double radius_, half_length_;
};

}  // namespace supernormal
