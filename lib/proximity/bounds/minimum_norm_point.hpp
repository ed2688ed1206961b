// The point of a hull that is nearest to the origin.
#pragma once

#include <array>
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

/// The point of the convex hull of `points` (at least one) nearest to the origin, by an active-set method (Wolfe, Finding the
/// nearest point in a polytope, Math. Programming 11, 1976): the point that lies lowest along the best so far joins the simplex
/// that holds it.
///
/// However near the origin is to a facet, `normal` is the facet's: taken from its edges, not from the point, whose digits cancel.
MinimumNormPoint minimum_norm_point(std::span<const Vector3> points);

/// Four of the points, whose tetrahedron has the origin inside; none where the hull has not, or has it on a face of what the same
/// method comes to.
std::optional<std::array<Vector3, 4>> enclosing_tetrahedron(std::span<const Vector3> points);

}  // namespace supernormal
