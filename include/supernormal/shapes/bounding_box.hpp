// The box around a body along the axes of the world.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The smallest box that contains a body, along the axes of the frame that the pose refers to.
struct BoundingBox {
  Vector3 low = Vector3::Zero();   ///< m
  Vector3 high = Vector3::Zero();  ///< m
};

/// Returns the box between the body's six supporting planes that are perpendicular to the axes. It takes no search, only three to
/// six evaluations of the support function. The error is a few units of rounding of the position and the body's extent; a broad
/// phase should enlarge the box by this. If a number of the pose or the shape is not finite, the result is not finite. A matrix
/// that is not a rotation is used as it is.
SUPERNORMAL_API BoundingBox find_bounding_box(const Shape& shape, const Pose& pose);

}  // namespace supernormal
