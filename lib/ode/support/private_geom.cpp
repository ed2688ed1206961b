#include "ode/support/private_geom.hpp"

namespace supernormal::ode {

void destroy_private_geom(dGeomID geom) {
  if (dInitODE2(0) == 0) return;
  dGeomDestroy(geom);
  dCloseODE();
}

}  // namespace supernormal::ode
