// The position and orientation of a body.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "supernormal/export.h"

namespace supernormal {

/// x_world = rotation x_body + position. Queries refuse a matrix that is not a rotation, with Status::InvalidInput or an empty
/// result. It must be orthonormal and right-handed to 1e-5: the sum of the errors of the defining equations. Queries use the matrix
/// unchanged, so their answers are only as exact as it is. Orthonormalise a product of many rotations from time to time. C and
/// Python repair a matrix (lib/guide.md). Of a quaternion: Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix(), with
/// <Eigen/Geometry>.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< orthonormal, right-handed

  /// Whether all numbers are equal.
  bool operator==(const Pose& other) const { return position == other.position && rotation == other.rotation; }
};

/// The text of a pose: Pose(position=(x, y, z), rotation=((…), (…), (…))), the matrix by rows. Numbers have the fewest digits that
/// read back as the same double.
SUPERNORMAL_API std::string describe(const Pose& pose);

/// The pose with this description. Throws std::invalid_argument for any other text, with the place and what is expected there, or
/// if the matrix is not a rotation (Pose) or a coordinate is not within 1e150 m.
SUPERNORMAL_API Pose read_pose(std::string_view text);

}  // namespace supernormal
