// The position and orientation of a body.
#pragma once

#include <Eigen/Core>

namespace supernormal {

/// x_world = rotation x_body + position. Queries refuse a matrix that is not a rotation, with Status::InvalidInput or an empty
/// result. It must be orthonormal and right-handed to 1e-5: the sum of the errors of the defining equations. Queries use the matrix
/// unchanged, so their answers are only as exact as it is. Orthonormalise a product of many rotations from time to time.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< orthonormal, right-handed
};

}  // namespace supernormal
