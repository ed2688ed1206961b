/* An egg and a lens, given to the library only by their support functions (bodies.c), touch a plane, a box, a superellipsoid and
 * another lens from above. Prints the gap, the contacts and the normal of each pair, and the mass of the two bodies. */
#include <math.h>
#include <stdio.h>

#include "bodies.h"

enum { MAX_CONTACTS = 8, COLLIDERS = 4, BODIES = 2 };

static const double kOverlap = 0.01; /* m */

typedef struct Named {
  const char* name;
  dGeomID geom;
} Named;

/* Lowers the top of a geom, which is `height` above its centre, to the origin. */
static dGeomID below(dGeomID geom, double height) {
  if (geom != NULL) dGeomSetPosition(geom, 0, 0, (dReal)-height);
  return geom;
}

/* Raises the body so high above the origin that its lowest point is kOverlap below it. */
static void lower_onto_origin(dGeomID body) {
  const dVector3 down = {0, 0, -1};
  dVector3 lowest;
  dGeomSetPosition(body, 0, 0, 0);
  snGeomSupport(body, down, lowest);
  dGeomSetPosition(body, -lowest[0], -lowest[1], (dReal)(-lowest[2] - kOverlap));
}

/* Prints one line of the table. Returns whether the deepest contact is as deep as the gap, and has an upward normal. */
static int report(Named body, Named collider) {
  dContactGeom contacts[MAX_CONTACTS];
  const int count = dCollide(body.geom, collider.geom, MAX_CONTACTS, contacts, sizeof(dContactGeom));
  snProximity gap = {0};
  if (count == 0 || !snGeomProximity(body.geom, collider.geom, &gap)) {
    printf("%-4s | %-14s | no contact: %s\n", body.name, collider.name, snLastError());
    return 0;
  }
  const dReal* n = contacts[0].normal; /* into the body */
  printf("%-4s | %-14s | %9.6f | %8d | %8.6f | %6.3f %6.3f %6.3f | %d\n", body.name, collider.name, (double)gap.gap, count,
         (double)contacts[0].depth, (double)n[0], (double)n[1], (double)n[2], gap.evaluations);
  return fabs(contacts[0].depth + gap.gap) < 1e-6 && n[2] > 0.999;
}

static void print_masses(dGeomID egg, dGeomID lens_geom, Lens lens) {
  dMass mass;
  snMassSet(&mass, 1000, egg);
  printf("egg: mass %.6f kg, centre of mass at z = %.6f m\n", (double)mass.mass, (double)mass.c[2]);
  if (!snMassSet(&mass, 1000, lens_geom)) printf("lens: %s\n", snLastError());
  set_lens_mass(&mass, 1000, lens);
  printf("lens, by its own formula: mass %.6f kg\n", (double)mass.mass);
}

int main(int argc, char** argv) {
  (void)argv;
  if (argc > 1) {
    puts("usage: user_shape\nCollides an egg and a lens, given by callbacks, and prints gap, contacts and mass.");
    return 2;
  }
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  const Egg egg = {0.4, 0.1};
  const Lens lens = {0.6, 0.3};
  const Named bodies[BODIES] = {{"egg", create_egg(0, egg)}, {"lens", create_lens(0, lens)}};
  const Named colliders[COLLIDERS] = {{"plane", dCreatePlane(0, 0, 0, 1, 0)},
                                      {"box", below(dCreateBox(0, 2, 2, 1), 0.5)},
                                      {"superellipsoid", below(snCreateSuperellipsoid(0, 1, (dReal)0.8, (dReal)0.4, 4, 3), 0.4)},
                                      {"lens", below(create_lens(0, (Lens){1, (dReal)0.7}), 0.3)}};
  dMatrix3 tilt;
  dRFromAxisAndAngle(tilt, 1, 2, 0, (dReal)0.25);
  int agrees = 1;
  printf("body | collider       | gap (m)   | contacts | depth    | normal               | evaluations\n");
  for (int k = 0; k < BODIES; ++k) {
    if (bodies[k].geom == NULL) {
      printf("%s refused: %s\n", bodies[k].name, snLastError());
      return 1;
    }
    dGeomSetRotation(bodies[k].geom, tilt);
    lower_onto_origin(bodies[k].geom);
    for (int i = 0; i < COLLIDERS; ++i) agrees &= report(bodies[k], colliders[i]);
  }
  print_masses(bodies[0].geom, bodies[1].geom, lens);
  printf(agrees ? "every pair touches and agrees\n" : "some pair does not touch or does not agree\n");

  for (int k = 0; k < BODIES; ++k) dGeomDestroy(bodies[k].geom);
  for (int i = 0; i < COLLIDERS; ++i) dGeomDestroy(colliders[i].geom);
  snClose();
  dCloseODE();
  return agrees ? 0 : 1;
}
