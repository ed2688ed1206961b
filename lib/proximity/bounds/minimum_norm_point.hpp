// The point of a hull that is nearest to the origin.
#pragma once

#include <span>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The point of the convex hull of `points` (at least one) nearest to the origin, by Wolfe's active-set method (Finding the nearest
/// point in a polytope, Math. Programming 11, 1976). It is a convex combination of the points to rounding whatever happens; where
/// four of them surround the origin it is zero.
Vector3 minimum_norm_point(std::span<const Vector3> points);

}  // namespace supernormal
