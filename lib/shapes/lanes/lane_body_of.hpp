// From an ellipsoid or superellipsoid to the numbers for queries in lanes.
#pragma once

#include "supernormal/shapes/lane_body.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The numbers of a shape with these half-axes (m) and exponents. Only the shape's radii are read.
LaneBody lane_body_of(const Shape& shape, const Vector3& half_axes, double delta, double epsilon);

}  // namespace supernormal
