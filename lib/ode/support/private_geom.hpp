#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// Destroys a geom that a thread keeps to probe others with. At the end of a thread ODE may be closed, and except on x86 it then
/// has no lock any more through which it frees a placeable geom: the program would abort. So ODE is opened for this moment.
inline void destroy_private_geom(dGeomID geom) {
  if (dInitODE2(0) == 0) return;
  dGeomDestroy(geom);
  dCloseODE();
}

}  // namespace supernormal::ode
