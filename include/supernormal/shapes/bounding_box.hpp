// The box around a body along the axes of the world.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The smallest box that holds a body, along the axes of the frame that the pose refers to.
struct BoundingBox {
  Vector3 low = Vector3::Zero();   ///< m
  Vector3 high = Vector3::Zero();  ///< m
};

/// Returns the box between the body's six supporting planes that are perpendicular to the axes: no search, three to six evaluations
/// of the support function. It is exact to a few units of rounding of the position and the body's extent, by which a broad phase
/// should enlarge it. Numbers that are not finite in the pose, or of the shape, come out as such, and a
/// matrix that is no rotation counts as it is.
SUPERNORMAL_API BoundingBox find_bounding_box(const Shape& shape, const Pose& pose);

}  // namespace supernormal
