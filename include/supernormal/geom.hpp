/// Geoms of ODE from shapes of C++.
#pragma once

#include <ode/ode.h>

#include <memory>

#include "supernormal/export.h"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// Creates a geom of any shape, also of a class of your own, and adds it to `space` unless that is null. The geom shares the shape
/// with the program, and uses it from every thread that queries the geom; the shape must not change. Otherwise the geom is one of
/// supernormal.h: a Superellipsoid or a Superovoid has its parameters, a Rounded its rounding.
///
/// Throws std::invalid_argument if `shape` is null, if a half-extent is outside [1e-30, 1e30] m, if support function and boundary
/// points do not belong to a convex body in the directions that CallbackShape tests, or if `space` is no space.
SUPERNORMAL_ODE_API dGeomID create_geom(dSpaceID space, const std::shared_ptr<const Shape>& shape);

}  // namespace supernormal::ode
