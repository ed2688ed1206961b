// How deep the manifold points are, and where on the body.
#pragma once

#include "contact/manifold/common_corners.hpp"

namespace supernormal {

// Faces count as flat between the manifold points. So only differences of their separations matter (lib/contact/theory.md).

/// m; a manifold point on the polygon whose separation exceeds the depth by more than this is in the air.
double allowed_separation(const SupportPolygon& polygon);

/// Writes the manifold points for a solver that knows the gap of each, which is minus its depth. `gap` (m) is the gap of the point
/// with the smallest separation. The allowed separation does not count: a point in the air supports nothing until it has come down.
void write_gaps(const CornerList& corners, double gap, ContactManifold& manifold);

/// Writes the manifold points of an overlap for a solver that knows no gaps. A point has at least the depth 0. If its gap exceeds
/// `allowed_separation` (m), the point moves in towards the deepest point, to where the gap is just as much.
void write_depths(const CornerList& corners, double allowed_separation, double gap, ContactManifold& manifold);

/// Moves a point along the normal to the boundary of manifold.placed_on, if it is placed on a body and the line meets the body.
/// Adds to the evaluations of the manifold.
void put_on_boundary(ContactManifold& manifold, Vector3& point);

/// Moves the manifold points, which are in a plane along the tangent plane, to the boundary of manifold.placed_on.
void put_on_body(const SupportPolygon& polygon, ContactManifold& manifold);

}  // namespace supernormal
