// The point of a hull that is nearest to the origin.
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
  Vector3 normal;  ///< unit, from the origin to it; zero where the origin is inside, or a point is the origin
};

/// The point of the hull of a growing set of points that is nearest to the origin, by an active-set method (Wolfe, Finding the
/// nearest point in a polytope, Math. Programming 11, 1976): the point that lies lowest along the best so far joins the simplex
/// that holds it. The next search begins with this simplex, which a few new points change little.
///
/// However near the origin is to a facet, `normal` is the facet's: taken from its edges, not from the point, whose digits cancel.
class MinimumNormSearch {
 public:
  /// The nearest point of the hull of `points` (at least one) and of the last simplex, whose vertices need not be among them any
  /// more. Where that simplex is of no use it is forgotten.
  const MinimumNormPoint& update(std::span<const Vector3> points);

  /// The tetrahedron that holds the origin inside, if one was found.
  const std::optional<std::array<Vector3, 4>>& around() const { return around_; }

 private:
  void search(std::span<const Vector3> points);
  /// Moves to the nearest point of the hull of the simplex and `vertex`: in one of the faces of that hull which have the new
  /// vertex, or at the origin if that is inside. Returns whether this is nearer than before.
  bool add(const Vector3& vertex);
  void offer(const Vector3& a);
  void offer(const Vector3& a, const Vector3& b);
  void offer(const Vector3& a, const Vector3& b, const Vector3& c);
  /// `point` is a convex combination of the vertices, `direction` that of its foot, of any length.
  bool is_better(const Vector3& point, const Vector3& direction);
  /// Whether the tetrahedron of the triangle and `vertex` holds the origin inside, beyond the rounding of each determinant: a point
  /// of a flat tetrahedron's face is no proof that the bodies overlap.
  bool is_origin_inside(const Vector3& vertex) const;

  std::array<Vector3, 3>
      vertices_;  // of the simplex that holds the nearest point in its interior: a point, a segment or a triangle
  std::size_t count_ = 0;
  MinimumNormPoint best_{Vector3::Zero(), std::numeric_limits<double>::infinity(), Vector3::Zero()};
  std::optional<std::array<Vector3, 4>> around_;
};

/// The nearest point of the hull of `points`, at least one, by one search.
MinimumNormPoint minimum_norm_point(std::span<const Vector3> points);

/// Four of the points, whose tetrahedron has the origin inside; none where the hull has not, or has it on a face of what the same
/// method comes to.
std::optional<std::array<Vector3, 4>> enclosing_tetrahedron(std::span<const Vector3> points);

}  // namespace supernormal
