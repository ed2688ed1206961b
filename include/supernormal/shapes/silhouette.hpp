// Projected area and surface area of a body.
#pragma once

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// m^2; the area of the body's projection along `direction` (body's frame, any length but 0). It is the area of a polygon of 48
/// boundary points whose normals are perpendicular to the direction, enlarged as for a circle. Exact to rounding for ellipsoids,
/// 0.3 % too large for a box, and in between for shapes between these two.
SUPERNORMAL_API double projected_area(const Shape& shape, const Vector3& direction);

/// m^2; four times the mean projected area (Cauchy's formula; Schneider, Convex Bodies, section 5.3) over 2 x 200 directions.
/// Accurate to 1e-3 for bodies with aspect ratios up to 5.
SUPERNORMAL_API double surface_area(const Shape& shape);

}  // namespace supernormal
