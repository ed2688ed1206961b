// Rotations between directions.
#pragma once

#include <Eigen/Geometry>

namespace supernormal::test {

/// The smallest rotation that takes one direction to another, by Eigen::Quaterniond::FromTwoVectors. Its singular value
/// decomposition takes seconds to compile, so it is compiled once.
Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace supernormal::test
