// dGeomMoved for Windows, where ODE's DLL does not export it: the geom, or its body, is given the position that it has.
#include <ode/ode.h>

#ifdef _WIN32
extern "C" void dGeomMoved(dGeomID geom) {
  const dBodyID body = dGeomGetBody(geom);
  const dReal* position = body != nullptr ? dBodyGetPosition(body) : dGeomGetPosition(geom);
  const dReal x = position[0], y = position[1], z = position[2];
  if (body != nullptr) {
    dBodySetPosition(body, x, y, z);
  } else {
    dGeomSetPosition(geom, x, y, z);
  }
}
#endif
