/* Two bodies that the library does not have, given by their support function and boundary point, as snCreateConvex wants. */
#ifndef USER_SHAPE_BODIES_H
#define USER_SHAPE_BODIES_H

#include <supernormal/supernormal.h>

/* An egg: h(n) = size (1 + bulge nz^3). Convex for |bulge| <= 1/7. */
typedef struct Egg {
  double size; /* m */
  double bulge;
} Egg;

/* A lens: the intersection of two balls of radius R whose centres are 2 offset apart, along z; offset < R. Its edge is sharp. */
typedef struct Lens {
  double R;      /* m */
  double offset; /* m */
} Lens;

/* Creates a geom in `space`. The body is kept until dGeomDestroy, and freed then. 0 when snCreateConvex refuses (snLastError). */
dGeomID create_egg(dSpaceID space, Egg egg);
dGeomID create_lens(dSpaceID space, Lens lens);

/* Sets mass and inertia of the lens. snMassSet refuses it: it integrates over the normals, and those of the edge see no volume.
 * (For the egg, which is smooth, snMassSet is accurate to 1e-10.) */
void set_lens_mass(dMass* mass, double density, Lens lens);

#endif
