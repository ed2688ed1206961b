// Curvature and size of a geom, as Hertz's contact needs them.
#pragma once

#include <ode/ode.h>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::effects {

/// The curvature of the geom's boundary at the point with outward normal n (world frame), 1/m. Among ODE's own geoms dSphere,
/// dCapsule and dCylinder are curved; all others count as flat, and so do their edges, for which Hertz's theory has no answer.
Matrix3 curvature_of(dGeomID geom, const Vector3& n);

/// m; the mean of the half-extents of a body that fits into a box, infinite for others.
double mean_half_extent(dGeomID geom);

}  // namespace supernormal::effects
