/* Collides an egg and a lens, given to the library only by their support functions (bodies.c), with every class of geom that ODE
 * has and with bodies of this library, lowered onto the top of each collider by a little more than it takes to touch. Prints, for
 * each pair, the gap, the contacts and the normal, and the mass of the two bodies. */
#include <math.h>
#include <stdio.h>

#include "bodies.h"

enum { MAX_CONTACTS = 8 };

static const double kOverlap = 0.01; /* m */

/* One geom of every class that ODE has, a superellipsoid and a lens. */
typedef struct Collider {
  const char* name;
  dGeomID geom;
} Collider;

enum { COLLIDER_COUNT = 11 };

/* A pyramid with a flat top, as a hull and as a mesh. ODE keeps pointers to these arrays. */
static const dReal kHullPoints[] = {-1,   -1,   -1, 1,   -1,   -1, 1,   1,   -1, -1,   1,   -1,
                                    -0.5, -0.5, 0,  0.5, -0.5, 0,  0.5, 0.5, 0,  -0.5, 0.5, 0};
#define SLANT 0.89442719099991588 /* the sides: 2 to 1 */
#define FALL 0.44721359549995794
static const dReal kHullPlanes[] = {0,     0, 1,    0,    0, 0,      -1,   1,    -SLANT, 0,     FALL, FALL,
                                    SLANT, 0, FALL, FALL, 0, -SLANT, FALL, FALL, 0,      SLANT, FALL, FALL};
static const unsigned int kHullPolygons[] = {4, 4, 5, 6, 7, 4, 3, 2, 1, 0, 4, 0, 4, 7, 3,
                                             4, 1, 2, 6, 5, 4, 0, 1, 5, 4, 4, 2, 3, 7, 6};
static const double kMeshVertices[] = {-1,   -1,   -1, 1,   -1,   -1, 1,   1,   -1, -1,   1,   -1,
                                       -0.5, -0.5, 0,  0.5, -0.5, 0,  0.5, 0.5, 0,  -0.5, 0.5, 0};
static const dTriIndex kMeshTriangles[] = {4, 5, 6, 4, 6, 7, 0, 3, 2, 0, 2, 1, 0, 4, 7, 0, 7, 3,
                                           1, 2, 6, 1, 6, 5, 0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6};

static dTriMeshDataID mesh_data;
static dHeightfieldDataID terrain_data;

static dReal hill(void* user, int x, int z) {
  (void)user;
  const double u = x - 4, v = z - 4; /* nodes from the middle, 0.25 m apart */
  return (dReal)(-0.02 * (u * u + v * v));
}

static dGeomID create_terrain(void) {
  terrain_data = dGeomHeightfieldDataCreate();
  dGeomHeightfieldDataBuildCallback(terrain_data, NULL, hill, 2, 2, 9, 9, 1, 0, 0, 0);
  dGeomHeightfieldDataSetBounds(terrain_data, -1, 0);
  const dGeomID terrain = dCreateHeightfield(0, terrain_data, 1);
  dMatrix3 upright; /* ODE's heightfields rise along y */
  dRFromAxisAndAngle(upright, 1, 0, 0, (dReal)(M_PI / 2));
  dGeomSetRotation(terrain, upright);
  return terrain;
}

static dGeomID create_mesh(void) {
  mesh_data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(mesh_data, kMeshVertices, 3 * sizeof(double), 8, kMeshTriangles, 36, 3 * sizeof(dTriIndex));
  return dCreateTriMesh(0, mesh_data, NULL, NULL, NULL);
}

static dGeomID below(dGeomID geom, double depth) {
  dGeomSetPosition(geom, 0, 0, (dReal)-depth);
  return geom;
}

/* The ray goes from far below, through the origin, to 0.6 m above it: it ends inside the body. */
static dGeomID create_ray(void) {
  const dGeomID ray = dCreateRay(0, 3);
  dGeomRaySet(ray, 0, 0, (dReal)-2.4, 0, 0, 1);
  return ray;
}

/* The top of each collider is at the origin, so that a body above it touches there. */
static void create_colliders(Collider colliders[COLLIDER_COUNT]) {
  const Collider all[COLLIDER_COUNT] = {
      {"plane", dCreatePlane(0, 0, 0, 1, 0)},
      {"sphere", below(dCreateSphere(0, (dReal)0.7), 0.7)},
      {"box", below(dCreateBox(0, 2, 2, 1), 0.5)},
      {"capsule", below(dCreateCapsule(0, (dReal)0.3, 1), 0.8)},
      {"cylinder", below(dCreateCylinder(0, (dReal)0.5, 1), 0.5)},
      {"convex hull", dCreateConvex(0, kHullPlanes, 6, kHullPoints, 8, kHullPolygons)},
      {"trimesh", create_mesh()},
      {"heightfield", create_terrain()},
      {"ray", create_ray()},
      {"superellipsoid", below(snCreateSuperellipsoid(0, 1, (dReal)0.8, (dReal)0.4, 4, 3), 0.4)},
      {"lens", below(create_lens(0, (Lens){1, (dReal)0.7}), 0.3)},
  };
  for (int i = 0; i < COLLIDER_COUNT; ++i) colliders[i] = all[i];
}

static void destroy_colliders(Collider colliders[COLLIDER_COUNT]) {
  for (int i = 0; i < COLLIDER_COUNT; ++i) dGeomDestroy(colliders[i].geom);
  dGeomTriMeshDataDestroy(mesh_data);
  dGeomHeightfieldDataDestroy(terrain_data);
}

/* Whether the contacts are as ODE requires and agree with the gap: their normals point into the body, upwards. */
static int is_sound(const dContactGeom* contacts, int count, const snProximity* gap, int is_ray) {
  double deepest = 0;
  for (int i = 0; i < count; ++i) {
    const dReal* n = contacts[i].normal;
    if (fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) > 1e-6 || n[2] < 0.999) return 0;
    if (contacts[i].depth > deepest) deepest = contacts[i].depth;
  }
  if (is_ray) return count == 1; /* the depth is the distance along the ray */
  return count > 0 && fabs(deepest + gap->gap) < 1e-6;
}

/* Replaces small numbers, so that 0.000 is printed and not -0.000. */
static double unsigned_zero(double x) { return fabs(x) < 5e-4 ? 0 : x; }

/* Prints one line of the table. Returns whether the pair touches and agrees. */
static int report(const char* name, dGeomID body, const Collider* collider) {
  dContactGeom contacts[MAX_CONTACTS];
  const int count = dCollide(body, collider->geom, MAX_CONTACTS, contacts, sizeof(dContactGeom));
  snProximity gap = {0};
  const int is_ray = dGeomGetClass(collider->geom) == dRayClass;
  const int has_gap = snGeomProximity(body, collider->geom, &gap);
  if (count == 0) {
    printf("%-5s | %-14s | no contact: %s\n", name, collider->name, snLastError());
    return 0;
  }
  char distance[32] = "-";
  if (has_gap) snprintf(distance, sizeof distance, "%.6f", (double)gap.gap);
  const dReal* n = contacts[0].normal;
  printf("%-5s | %-14s | %9s | %d | %8.6f | %6.3f %6.3f %6.3f | %d\n", name, collider->name, distance, count,
         (double)contacts[0].depth, unsigned_zero(n[0]), unsigned_zero(n[1]), unsigned_zero(n[2]), gap.evaluations);
  return is_sound(contacts, count, &gap, is_ray);
}

/* Raises the body so high above the origin that its lowest point is kOverlap below it. */
static void lower_onto_origin(dGeomID body) {
  const dVector3 down = {0, 0, -1};
  dVector3 lowest;
  dGeomSetPosition(body, 0, 0, 0);
  snGeomSupport(body, down, lowest);
  dGeomSetPosition(body, -lowest[0], -lowest[1], (dReal)(-lowest[2] - kOverlap));
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
    puts(
        "usage: user_shape\nCollides an egg and a lens, given by callbacks, with every class of geom, and prints gap, contacts and "
        "mass.");
    return 2;
  }
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  Collider colliders[COLLIDER_COUNT];
  create_colliders(colliders);

  const Egg egg = {0.4, 0.1};
  const Lens lens = {0.6, 0.3};
  const char* names[] = {"egg", "lens"};
  dGeomID bodies[] = {create_egg(0, egg), create_lens(0, lens)};
  dMatrix3 tilt;
  dRFromAxisAndAngle(tilt, 1, 2, 0, (dReal)0.25);

  int sound = 1;
  printf("body  | collider        | gap (m)   | contacts, the first one's depth (m) and normal | evaluations\n");
  for (int k = 0; k < 2; ++k) {
    if (bodies[k] == NULL) {
      printf("%s refused: %s\n", names[k], snLastError());
      return 1;
    }
    dGeomSetRotation(bodies[k], tilt);
    lower_onto_origin(bodies[k]);
    for (int i = 0; i < COLLIDER_COUNT; ++i) sound &= report(names[k], bodies[k], &colliders[i]);
  }
  print_masses(bodies[0], bodies[1], lens);
  printf(sound ? "every pair touches and agrees\n" : "some pair does not touch or does not agree\n");

  for (int k = 0; k < 2; ++k) dGeomDestroy(bodies[k]);
  destroy_colliders(colliders);
  snClose();
  dCloseODE();
  return sound ? 0 : 1;
}
