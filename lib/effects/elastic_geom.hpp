// What Hertz's contact asks of a geom.
#pragma once

#include <ode/ode.h>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::effects {

/// The curvature of the geom's boundary at the point with outward normal n (world frame), 1/m. Of ODE's own geoms dSphere, dCapsule
/// and dCylinder are curved; all others count as flat, their edges too, for which Hertz has no answer.
Matrix3 curvature_of(dGeomID geom, const Vector3& n);

/// m; the mean of the half-extents of a body that fits into a box, infinite of others.
double mean_half_extent(dGeomID geom);

}  // namespace supernormal::effects
