// Curvature and size of a geom, for Hertz's contact.
#pragma once

#include <ode/ode.h>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::effects {

/// The curvature tensor of the geom's boundary at the point with outward unit normal n (world frame), 1/m. Among ODE's own geoms
/// dSphere, dCapsule and dCylinder are curved. All others count as flat. Their edges do too, because Hertz's theory does not cover
/// edges.
Matrix3 curvature_of(dGeomID geom, const Vector3& n);

/// m; the mean half-extent of a geom in its own frame, however it is turned; infinite for an unbounded one. Of a class that only
/// has a bounding box in the frame of the world (dGeomTransform, dHeightfield) it is that of the box.
double mean_half_extent(dGeomID geom);

}  // namespace supernormal::effects
