#include "ode/geom/moved.hpp"

namespace supernormal::ode {

// A geom with an offset would be placed with rounding, so the body is placed.
void set_moved(dGeomID geom) {
  const dBodyID body = dGeomGetBody(geom);
  const dReal* position = body != nullptr ? dBodyGetPosition(body) : dGeomGetPosition(geom);
  const dReal x = position[0], y = position[1], z = position[2];
  if (body != nullptr) {
    dBodySetPosition(body, x, y, z);
  } else {
    dGeomSetPosition(geom, x, y, z);
  }
}

}  // namespace supernormal::ode
