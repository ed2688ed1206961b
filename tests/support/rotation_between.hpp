// Rotations between directions.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace supernormal::test {

/// The smallest rotation that takes one direction to another; half a turn about any axis across opposite ones. Eigen's
/// FromTwoVectors takes a singular value decomposition there, which is seconds to compile.
inline Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double twice_cosine = std::sqrt(2 * (1 + a.dot(b)));  // of half the angle
  Eigen::Quaterniond rotation;
  rotation.w() = twice_cosine / 2;
  rotation.vec() = twice_cosine > 1e-6 ? Eigen::Vector3d(a.cross(b) / twice_cosine) : a.unitOrthogonal();
  return rotation.normalized();
}

}  // namespace supernormal::test
