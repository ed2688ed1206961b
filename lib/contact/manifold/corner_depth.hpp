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

/// The outermost point of the body's boundary on the line through `place` along `normal` (unit, out of the body); `place` itself if
/// the line misses the body. Adds to `evaluations`.
Vector3 find_boundary_point(const Shape& shape, const Pose& pose, const Vector3& normal, const Vector3& place, int& evaluations);

/// Moves the manifold points of the tangent plane with this normal, which points out of the body, to the body's boundary. The
/// points of a line stay outside, on the sloped line, by at most SupportPolygon::rise().
void put_on_body(const Shape& shape, const Pose& pose, const SupportPolygon& polygon, const Vector3& normal,
                 ContactManifold& manifold);

}  // namespace supernormal
