#include "supernormal/shapes/bounding_box.hpp"

#include "shapes/lanes/four_normals.hpp"
#include "shapes/lanes/lane_body_of.hpp"

namespace supernormal {
namespace {

/// The support function in the three directions, all together. The first one is asked twice.
Vector3 supports_in_lanes(const LaneBody& body, const Matrix3& directions) {
  Eigen::Array<double, 4, 3> normals, points;
  normals << directions.array(), directions.row(0).array();
  Eigen::Array4d h;
  four_at_once()(body, normals.data(), h.data(), points.data());
  return h.head<3>();
}

}  // namespace

// Row i of the rotation is the world axis i in the body's frame.
BoundingBox find_bounding_box(const Shape& shape, const Pose& pose) {
  const LaneBody* const body = LaneBodies::of(shape);
  if (body != nullptr && !body->is_ellipsoid) {
    const Vector3 extents = supports_in_lanes(*body, pose.rotation);
    return {pose.position - extents, pose.position + extents};
  }
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
