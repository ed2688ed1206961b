#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// Destroys a geom that a thread keeps to probe others with. At the end of a thread ODE may be closed, and except on x86 it then
/// has no lock any more through which it frees a placeable geom: the program would abort. So ODE is opened for this moment.
void destroy_private_geom(dGeomID geom);

}  // namespace supernormal::ode
