// How deep the manifold points are.
#pragma once

#include "contact/manifold/common_corners.hpp"

namespace supernormal {

// Faces count as flat between the manifold points. So only differences of their separations matter (lib/contact/README.md).

/// m; a manifold point on the polygon whose separation exceeds the depth by more than this is in the air.
double allowed_separation(const SupportPolygon& polygon);

/// Writes the manifold points of an overlap of the depth `depth` (m). A point has this depth less its separation, and at least 0.
/// If its separation exceeds `depth` and `allowed_separation` (m), the point moves in towards the deepest point, to where the
/// separation is just as much.
void write_depths(const CornerList& corners, double allowed_separation, double depth, ContactManifold& manifold);

/// Writes the manifold points of bodies with a known gap, with minus the gap of each as its depth. `gap` (m) is the gap of the
/// point with the smallest separation.
void write_gaps(const CornerList& corners, double gap, ContactManifold& manifold);

}  // namespace supernormal
