// The point of a convex hull that is nearest to the origin.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A point of a hull, and the direction to it.
struct MinimumNormPoint {
  Vector3 point;   ///< m; a convex combination of the points, to rounding
  double norm;     ///< m; of the point
  Vector3 normal;  ///< unit, from the origin to the point; zero if the origin is inside, or if a point is the origin
};

/// The point of the hull of a growing set of points that is nearest to the origin, by an active-set method (Wolfe, Finding the
/// nearest point in a polytope, Math. Programming 11, 1976). The lowest point along the best so far joins the simplex that contains
/// the best. The next search starts from this simplex, because a few new points change it little.
///
/// However near the origin is to a facet, `normal` is the facet's normal. It comes from the facet's edges, because the digits of
/// the nearest point cancel.
class MinimumNormSearch {
 public:
  /// The nearest point of the hull of `points` (at least one) and the last simplex, whose vertices need not be among `points` any
  /// more. If the last simplex does not help, the search starts anew.
  const MinimumNormPoint& update(std::span<const Vector3> points);

  /// The vertices whose hull has the nearest point in its interior: one, two or three.
  std::span<const Vector3> simplex() const { return {vertices_.data(), count_}; }

  /// The tetrahedron that contains the origin inside, if the search found one.
  const std::optional<std::array<Vector3, 4>>& around() const { return around_; }

 private:
  void search(std::span<const Vector3> points);
  /// Moves to the nearest point of the hull of the simplex and `vertex`. It is in a face of this hull that contains `vertex`, or
  /// the origin if that is inside. Returns whether it is nearer than before.
  bool add(const Vector3& vertex);
  void offer(const Vector3& a);
  void offer(const Vector3& a, const Vector3& b);
  void offer(const Vector3& a, const Vector3& b, const Vector3& c);
  /// Takes `point`, a convex combination of the vertices, as the best if it is nearer. `direction` is its direction from the
  /// origin, of any length.
  bool is_better(const Vector3& point, const Vector3& direction);
  /// Whether the origin is inside the tetrahedron of the triangle and `vertex`, beyond the rounding of each determinant. A point on
  /// a face of a flat tetrahedron is no proof of overlap.
  bool is_origin_inside(const Vector3& vertex) const;

  std::array<Vector3, 3> vertices_;  // of the simplex with the nearest point in its interior: a point, a segment or a triangle
  std::size_t count_ = 0;
  MinimumNormPoint best_{Vector3::Zero(), std::numeric_limits<double>::infinity(), Vector3::Zero()};
  std::optional<std::array<Vector3, 4>> around_;
};

/// The nearest point of the hull of `points` (at least one), by one search.
MinimumNormPoint minimum_norm_point(std::span<const Vector3> points);

/// Four of the points whose tetrahedron contains the origin inside. Empty if the hull does not contain it, or if the search ends
/// with the origin on a face.
std::optional<std::array<Vector3, 4>> enclosing_tetrahedron(std::span<const Vector3> points);

}  // namespace supernormal
