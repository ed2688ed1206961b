// The convex hull of points.
#pragma once

#include <span>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The convex hull of points: a point, a segment, a triangle or a solid; h(n) = max n.v. Points inside the hull, coplanar and
/// repeated points are allowed. It refers to the caller's points and copies or allocates nothing, so one can be made for a single
/// query. The origin of the frame should be near the middle of the points, because solvers start from there.
class SUPERNORMAL_API Polytope final : public Shape {
 public:
  /// `points` in m, at least one, finite and within 1e30; std::invalid_argument otherwise.
  explicit Polytope(std::span<const Vector3> points);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override { return {.has_hessian = true, .has_nonsmooth_points = points_.size() > 1}; }
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const override;
  Vector3 half_extents() const override { return half_extents_; }
  double bounding_radius() const override { return bounding_radius_; }
  double min_curvature_radius_estimate() const override;

  /// Exact, except for points that are less than about a millionth of the size outside the hull of the others. Their volume may be
  /// missing, and relative_error includes it.
  MassProperties mass_properties() const override;

  std::span<const Vector3> points() const { return points_; }  ///< m; the points that it was made of

 private:
  std::span<const Vector3> points_;
  Vector3 half_extents_;
  double bounding_radius_;  // m
};

}  // namespace supernormal
