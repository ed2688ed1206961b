// The callbacks with which spaces cull pairs before dCollide.
#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// dGetAABBFn: the smallest axis-aligned box in the world frame, for any orientation. It is widened by rounding, and by the
/// displacement of a body that looks ahead.
void compute_aabb(dGeomID geom, dReal aabb[6]);

/// dAABBTestFn: returns 0 when a plane separates `geom` from `other_aabb`, the box of `other`.
int test_aabb(dGeomID geom, dGeomID other, dReal other_aabb[6]);

}  // namespace supernormal::ode
