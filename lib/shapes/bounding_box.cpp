#include "supernormal/shapes/bounding_box.hpp"

namespace supernormal {

// Row i of the rotation is the world axis i in the body's frame.
BoundingBox find_bounding_box(const Shape& shape, const Pose& pose) {
  BoundingBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 direction = pose.rotation.row(axis).transpose();
    const double up = shape.support(direction);
    const double down = shape.traits().is_symmetric ? up : shape.support(-direction);
    box.low[axis] = pose.position[axis] - down;
    box.high[axis] = pose.position[axis] + up;
  }
  return box;
}

}  // namespace supernormal
