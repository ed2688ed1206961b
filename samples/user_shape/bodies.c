#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How to find h and r for a body of your own:
 *
 *   h(n), the support function, is how far the body reaches along the unit vector n: the largest n.p of its points p.
 *   r(n), the boundary point, is the p that reaches so far. Its outward normal is n, and n.r(n) = h(n).
 *
 * If you have h as a formula, extend it to vectors of any length so that h(t n) = t h(n); then r is its gradient. If you have the
 * body as a formula, find the point with normal n first; then h = n.r. The egg is made in the first way, the lens in the second.
 *
 * The functions are called with unit vectors in the body's frame, from whatever thread collides: they only read what `user` points
 * to. A Hessian (the gradient of r) would make queries a little cheaper. Without it the library takes differences of r. */

/* h(x) = size (|x| + bulge z^3/|x|^2) for any x; its gradient at |x| = 1 is
 *     size (n + bulge (3 nz^2 ez - 2 nz^3 n)). */
static dReal egg_support(const void* user, const dReal n[3]) {
  const Egg* egg = user;
  return (dReal)(egg->size * (1 + egg->bulge * n[2] * n[2] * n[2]));
}

static void egg_point(const void* user, const dReal n[3], dReal point[3]) {
  const Egg* egg = user;
  const double radial = egg->size * (1 - 2 * egg->bulge * n[2] * n[2] * n[2]);
  for (int i = 0; i < 3; ++i) point[i] = (dReal)(radial * n[i]);
  point[2] += (dReal)(3 * egg->size * egg->bulge * n[2] * n[2]);
}

/* The upper cap belongs to the ball around (0, 0, -offset), and has the normals with nz > offset/R. The edge, a circle, has all
 * normals between those of the two caps there. */
static void lens_point(const void* user, const dReal n[3], dReal point[3]) {
  const Lens* lens = user;
  const double edge = sqrt(lens->R * lens->R - lens->offset * lens->offset); /* radius of the edge */
  const double across = sqrt(n[0] * n[0] + n[1] * n[1]);
  if (fabs(n[2]) * lens->R > lens->offset) {
    for (int i = 0; i < 3; ++i) point[i] = (dReal)(lens->R * n[i]);
    point[2] -= (dReal)copysign(lens->offset, n[2]);
  } else {
    point[0] = (dReal)(edge * n[0] / across);
    point[1] = (dReal)(edge * n[1] / across);
    point[2] = 0;
  }
}

static dReal lens_support(const void* user, const dReal n[3]) {
  dReal r[3];
  lens_point(user, n, r);
  return n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
}

/* Integrates slices across z: the integrands are polynomials of degree 4 on each half, for which three Gauss points are exact. */
void set_lens_mass(dMass* mass, double density, Lens lens) {
  const double node[3] = {-0.77459666924148338, 0, 0.77459666924148338}, weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  const double height = lens.R - lens.offset; /* height of a cap */
  double m = 0, along = 0, across = 0;
  for (int i = 0; i < 3; ++i) {
    const double z = 0.5 * height * (1 + node[i]);
    const double r2 = lens.R * lens.R - (z + lens.offset) * (z + lens.offset); /* squared radius of the slice */
    const double slice = density * M_PI * r2 * weight[i] * height;             /* both caps */
    m += slice;
    along += slice * r2 / 2;
    across += slice * (r2 / 4 + z * z);
  }
  dMassSetParameters(mass, (dReal)m, 0, 0, 0, (dReal)across, (dReal)across, (dReal)along, 0, 0, 0);
}

static dGeomID create(dSpaceID space, dReal (*support)(const void*, const dReal[3]),
                      void (*point)(const void*, const dReal[3], dReal[3]), const void* body, size_t bytes) {
  snShape shape = {0};
  shape.support = support;
  shape.point = point;
  shape.user = malloc(bytes);
  if (shape.user == NULL) return NULL;
  memcpy(shape.user, body, bytes);
  shape.release = free; /* called by dGeomDestroy */
  dGeomID geom = snCreateConvex(space, &shape);
  if (geom == NULL) free(shape.user); /* a refused shape is not released by the library */
  return geom;
}

dGeomID create_egg(dSpaceID space, Egg egg) { return create(space, egg_support, egg_point, &egg, sizeof egg); }

dGeomID create_lens(dSpaceID space, Lens lens) { return create(space, lens_support, lens_point, &lens, sizeof lens); }
