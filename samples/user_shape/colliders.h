/* One geom of every class that ODE has, a superellipsoid and a lens (bodies.h): the top of each is at the origin, so that a body
 * above it touches there. */
#ifndef USER_SHAPE_COLLIDERS_H
#define USER_SHAPE_COLLIDERS_H

#include <ode/ode.h>

typedef struct Collider {
  const char* name;
  dGeomID geom;
} Collider;

enum { COLLIDER_COUNT = 11 };

void create_colliders(Collider colliders[COLLIDER_COUNT]);
void destroy_colliders(Collider colliders[COLLIDER_COUNT]);

#endif
