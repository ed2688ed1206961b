#include "supernormal/contact/body_box.hpp"

#include <Eigen/Geometry>

namespace supernormal {

BodyBox BodyBox::of(const Shape& shape) {
  BodyBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const double high = shape.support(Vector3::Unit(axis));
    const double low = -shape.support(-Vector3::Unit(axis));
    box.centre[axis] = 0.5 * (low + high);
    box.half_lengths[axis] = 0.5 * (high - low);
  }
  return box;
}

bool BodyBox::contains(const Vector3& point, double margin) const {
  return ((point - centre).cwiseAbs().array() <= half_lengths.array() + margin).all();
}

// Separating axis test with 13 axes (Ericson, Real-Time Collision Detection, 5.2.9).
bool BodyBox::touches(const Pose& pose, const std::array<Vector3, 3>& vertices) const {
  Matrix3 local;
  for (int k = 0; k < 3; ++k) {
    local.col(k) = pose.rotation.transpose() * (vertices[static_cast<std::size_t>(k)] - pose.position) - centre;
  }
  if ((local.rowwise().minCoeff().array() > half_lengths.array()).any()) return false;
  if ((local.rowwise().maxCoeff().array() < -half_lengths.array()).any()) return false;
  const auto separates = [&](const Vector3& axis) {
    const Vector3 heights = local.transpose() * axis;
    const double reach = half_lengths.dot(axis.cwiseAbs());
    return heights.minCoeff() > reach || heights.maxCoeff() < -reach;
  };
  Matrix3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = local.col(k == 2 ? 0 : k + 1) - local.col(k);
  if (separates(edges.col(0).cross(edges.col(1)))) return false;
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) {
      if (separates(Vector3::Unit(axis).cross(edges.col(k)))) return false;
    }
  }
  return true;
}

}  // namespace supernormal
