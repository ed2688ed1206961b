// A box with sharp edges.
#pragma once

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// |x| <= a, |y| <= b, |z| <= c: h(n) = a|nx| + b|ny| + c|nz|. For the normal of a face or an edge, r(n) is one of its vertices.
class SUPERNORMAL_API Box final : public Shape {
 public:
  /// `half_lengths` in m, each in [0, 1e30]; std::invalid_argument otherwise.
  explicit Box(const Vector3& half_lengths);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override { return {.has_hessian = true, .is_symmetric = true, .has_nonsmooth_points = true}; }
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const override;
  bool surely_contains(const Vector3& point) const override;
  /// The half-lengths "x", "y" and "z".
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  Vector3 half_extents() const override { return half_lengths_; }
  double min_curvature_radius_estimate() const override;
  MassProperties mass_properties() const override;

  const Vector3& half_lengths() const { return half_lengths_; }  ///< m; along the axes of its frame

 private:
  Vector3 half_lengths_;
};

}  // namespace supernormal
