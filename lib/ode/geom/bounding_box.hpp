// The callbacks with which spaces cull pairs before dCollide.
#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// dGetAABBFn: the smallest axis-aligned box in the world frame, for any orientation. It is widened by rounding, and by the
/// displacement of a body that looks ahead.
void compute_aabb(dGeomID geom, dReal aabb[6]);

/// dAABBTestFn: returns 0 when a plane separates `geom` from `other_aabb`, the box of `other`.
int test_aabb(dGeomID geom, dGeomID other, dReal other_aabb[6]);

/// Tells ODE that the bounding box of a placeable geom has changed. ODE has dGeomMoved for this, but its DLL for Windows does not
/// export it. The other way: the geom, or its body, is given the position that it has. Not from within dSpaceCollide if the geom is
/// in a space.
void set_moved(dGeomID geom);

}  // namespace supernormal::ode
