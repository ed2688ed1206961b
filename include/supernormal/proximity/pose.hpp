// The position and attitude of a body.
#pragma once

#include <Eigen/Core>

namespace supernormal {

/// x_world = rotation x_body + position.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< orthonormal
};

}  // namespace supernormal
