#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// Tells ODE that the bounding box of a placeable geom has changed. ODE has dGeomMoved for this, but its DLL for Windows does not
/// export it. The other way: the geom, or its body, is given the position that it has. Not from within dSpaceCollide if the geom is
/// in a space.
void set_moved(dGeomID geom);

}  // namespace supernormal::ode
