// Poses in Python programs.
#pragma once

#include <optional>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::python {

/// N poses; Python: Poses.
struct Poses {
  std::vector<Pose> poses;
};

/// The pose of these arguments of Pose(). Throws std::invalid_argument as Pose() does.
Pose make_pose(const Vector3& position, const std::optional<Matrix3>& rotation, const std::optional<Eigen::Vector4d>& quaternion);

}  // namespace supernormal::python
