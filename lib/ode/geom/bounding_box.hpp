// The callbacks by which spaces cull pairs before they call dCollide.
#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// dGetAABBFn: the smallest box along the world's axes, in any attitude, widened by rounding only, and by the way of a body that
/// looks ahead.
void compute_aabb(dGeomID geom, dReal aabb[6]);

/// dAABBTestFn: 0 when a plane proves that `geom` and `other`, whose box is `other_aabb`, are apart.
int test_aabb(dGeomID geom, dGeomID other, dReal other_aabb[6]);

}  // namespace supernormal::ode
