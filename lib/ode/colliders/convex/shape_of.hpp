// Shapes of the core for the convex classes of ODE, from the parameters of a geom.
#pragma once

#include <ode/ode.h>

#include "ode/geom/convert.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/sphere.hpp"

namespace supernormal::ode {

inline Sphere sphere_of(dGeomID geom) { return Sphere(dGeomSphereGetRadius(geom)); }

inline Box box_of(dGeomID geom) {
  dVector3 lengths;
  dGeomBoxGetLengths(geom, lengths);
  return Box(0.5 * to_vector(lengths));
}

inline Capsule capsule_of(dGeomID geom) {
  dReal radius = 0, length = 0;
  dGeomCapsuleGetParams(geom, &radius, &length);
  return {radius, 0.5 * double{length}};
}

inline Cylinder cylinder_of(dGeomID geom) {
  dReal radius = 0, length = 0;
  dGeomCylinderGetParams(geom, &radius, &length);
  return {radius, 0.5 * double{length}};
}

}  // namespace supernormal::ode
