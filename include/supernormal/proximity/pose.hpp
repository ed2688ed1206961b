// The position and attitude of a body.
#pragma once

#include <Eigen/Core>

namespace supernormal {

/// x_world = rotation x_body + position. Queries refuse a matrix that is no rotation, as Status::InvalidInput or with an empty
/// result: it must be orthonormal and right-handed to 1e-5, the sum of the errors of the equations that make it so. They take it as
/// it is, so that their answers are as exact as it is; what a product of many rotations gathers is to be taken off from time to
/// time.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< orthonormal, right-handed
};

}  // namespace supernormal
