// The Minkowski sum of two shapes.
#pragma once

#include <memory>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// All points p + q with p in one shape and q in the other. h, r and H are the sums of the two shapes' values. With a sphere the
/// sum is Rounded. With a point, such as a Polytope of one point, the sum is the translated shape. Its mass properties come from
/// Shape::mass_properties(): to 1e-10 if both shapes are smooth, and without the volume behind flat faces, which relative_error
/// includes. (Schneider, Convex Bodies: The Brunn-Minkowski Theory, section 1.7.)
class SUPERNORMAL_API MinkowskiSum final : public Shape {
 public:
  /// Neither shape may be null; std::invalid_argument otherwise.
  MinkowskiSum(std::shared_ptr<const Shape> first, std::shared_ptr<const Shape> second);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override;
  Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const override;
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const override;
  bool crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const override;
  /// The parameters of both shapes.
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  Vector3 half_extents() const override { return first_->half_extents() + second_->half_extents(); }
  double min_curvature_radius_estimate() const override;
  double bounding_radius() const override { return first_->bounding_radius() + second_->bounding_radius(); }
  double rolling_radius() const override { return first_->rolling_radius() + second_->rolling_radius(); }

  const Shape& first() const { return *first_; }    ///< one of the two shapes
  const Shape& second() const { return *second_; }  ///< the other

 private:
  std::shared_ptr<const Shape> first_, second_;
};

}  // namespace supernormal
