/* One geom of every class that ODE has, a superellipsoid and a lens (bodies.h): the top of each is at the origin, so that a body
 * above it touches there. */
#ifndef USER_SHAPE_PARTNERS_H
#define USER_SHAPE_PARTNERS_H

#include <ode/ode.h>

typedef struct Partner {
  const char* name;
  dGeomID geom;
} Partner;

enum { PARTNER_COUNT = 11 };

void create_partners(Partner partners[PARTNER_COUNT]);
void destroy_partners(Partner partners[PARTNER_COUNT]);

#endif
