// The signed gap of two convex bodies, slowly and with a proof: independent of the solvers of lib/proximity.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::test {

/// lower <= signed gap <= upper, but for the rounding of the support functions.
struct GapBounds {
  double lower = 0;                   ///< m; s(normal)
  double upper = 0;                   ///< m
  Vector3 normal = Vector3::UnitX();  ///< unit, body 1's frame
  int evaluations = 0;                ///< evaluations of both boundary points
};

/// Encloses max s(n) over the whole unit sphere in an interval of at most `width` (m), by branch and bound on spherical triangles.
///
/// Each boundary point of the difference of the bodies bounds s from above everywhere: s(n) <= n.d for the d = point2 - point1 of
/// any normal. Over a triangle of directions the least of a few such bounds has its maximum at the solution of a linear program;
/// no part of the sphere is given up before that is below the best s found. Face and edge normals of either body need no special
/// case: where s has a nonsmooth point the bounds have it too, and their maximum is there.
///
/// Calls only point(n) of the shapes. Gives up after `max_evaluations`, with an interval that is too wide.
GapBounds bound_gap(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, double width,
                    int max_evaluations = 1000000);

}  // namespace supernormal::test
