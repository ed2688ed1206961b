// A rotation of the z-axis to a direction.
#pragma once

#include <Eigen/Geometry>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::test {

/// The shortest rotation of the z-axis to a direction other than the opposite one. (Eigen's FromTwoVectors also allows the opposite
/// one, by a singular value decomposition that takes seconds to compile.)
inline Matrix3 z_axis_to(const Vector3& direction) {
  const Vector3 n = direction.normalized();
  return Eigen::Quaterniond(1 + n.z(), -n.y(), n.x(), 0).normalized().toRotationMatrix();
}

}  // namespace supernormal::test
