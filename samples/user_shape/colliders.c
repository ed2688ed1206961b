#include "colliders.h"

#include <supernormal/supernormal.h>

#include "bodies.h"

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

void create_colliders(Collider colliders[COLLIDER_COUNT]) {
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

void destroy_colliders(Collider colliders[COLLIDER_COUNT]) {
  for (int i = 0; i < COLLIDER_COUNT; ++i) dGeomDestroy(colliders[i].geom);
  dGeomTriMeshDataDestroy(mesh_data);
  dGeomHeightfieldDataDestroy(terrain_data);
}
