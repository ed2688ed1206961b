// Cylinder with flat ends.
#pragma once

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// x^2 + y^2 <= radius^2, |z| <= half_length: h(n) = radius sqrt(nx^2 + ny^2) + half_length |nz|. For a normal of the side, r(n) is
/// at one of the two ends. For the normal of a cap, r(n) is the cap's centre.
class SUPERNORMAL_API Cylinder final : public Shape {
 public:
  /// Both in m, in [0, 1e30]; std::invalid_argument otherwise.
  Cylinder(double radius, double half_length);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override { return {.has_hessian = true, .is_symmetric = true, .has_nonsmooth_points = true}; }
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const override;
  bool crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const override;
  bool surely_contains(const Vector3& point) const override;
  /// "radius" and "half_length".
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  Vector3 half_extents() const override { return {radius_, radius_, half_length_}; }
  double min_curvature_radius_estimate() const override;
  MassProperties mass_properties() const override;

  double radius() const { return radius_; }            ///< m
  double half_length() const { return half_length_; }  ///< m; from the centre to a face

 private:
  double radius_, half_length_;
};

}  // namespace supernormal
