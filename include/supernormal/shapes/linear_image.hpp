// A shape stretched, sheared, rotated or mirrored.
#pragma once

#include <memory>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The points M p of all points p of a shape. h(n) = h_shape(M^T n), with h_shape homogeneous of degree 1. At the unit vector along
/// M^T n, r = M r_shape and H = M H_shape M^T / |M^T n|. (Schneider, Convex Bodies: The Brunn-Minkowski Theory, section 1.7.)
class SUPERNORMAL_API LinearImage final : public Shape {
 public:
  /// `shape` must not be null. `matrix` (m per m) must have singular values in [1e-30, 1e30] with a ratio of at most 1e12. Throws
  /// std::invalid_argument otherwise.
  LinearImage(std::shared_ptr<const Shape> shape, const Matrix3& matrix);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override;
  Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const override;
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const override;
  bool crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const override;
  /// The parameters of the shape before the map.
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  Vector3 half_extents() const override { return half_extents_; }
  double bounding_radius() const override { return bounding_radius_; }
  double min_curvature_radius_estimate() const override;

  /// The image of a ball is an ellipsoid, and a ball of this radius rolls inside the ellipsoid.
  double rolling_radius() const override { return shape_->rolling_radius() * smallest_ * (smallest_ / largest_); }

  /// As exact as the mass properties of the shape.
  MassProperties mass_properties() const override;

  const Shape& shape() const { return *shape_; }     ///< the shape before the map
  const Matrix3& matrix() const { return matrix_; }  ///< M

 private:
  std::shared_ptr<const Shape> shape_;
  Matrix3 matrix_, inverse_;
  double largest_, smallest_;  // the largest and smallest singular value
  Vector3 half_extents_;
  double bounding_radius_;  // m
};

}  // namespace supernormal
