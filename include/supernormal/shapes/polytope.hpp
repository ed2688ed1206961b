// The convex hull of some points.
#pragma once

#include <span>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The convex hull of points: a point, a segment, a triangle or a solid, h(n) = max n.v. Points inside the hull, coplanar and
/// repeated points do no harm. It refers to the caller's points: nothing is copied or allocated, so that one can be made for a
/// query. The origin of the frame should be near the middle of the points, because solvers start from there.
class SUPERNORMAL_API Polytope final : public Shape {
 public:
  /// `points` in m, at least one, finite and within 1e30; std::invalid_argument otherwise.
  explicit Polytope(std::span<const Vector3> points);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  bool has_hessian() const override { return true; }
  bool has_kinks() const override { return points_.size() > 1; }
  void add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& corners) const override;
  Vector3 half_extents() const override { return half_extents_; }
  double bounding_radius() const override { return bounding_radius_; }
  double min_curvature_radius_estimate() const override;

  /// Exact, except for points that lie less than about a millionth of the size outside the hull of the others: their volume may
  /// be missing, and relative_error accounts for it.
  MassProperties mass_properties() const override;

  std::span<const Vector3> points() const { return points_; }  ///< m; those that it was made of

 private:
  std::span<const Vector3> points_;
  Vector3 half_extents_;
  double bounding_radius_;  // m
};

}  // namespace supernormal
