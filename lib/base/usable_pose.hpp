// Tests for poses and normals that can be computed with.
#pragma once

#include <cmath>

#include "base/finite.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/pose.hpp"

namespace supernormal {

/// m; the square of a larger distance is not finite.
inline constexpr double kFarthest = 1e150;

/// The sum of the errors of the equations that make a matrix a rotation. The first two columns are perpendicular unit vectors, and
/// the third is their cross product. NaN if an entry is NaN.
inline double rotation_error(const Eigen::Matrix3d& R) {
  // The entries are read one by one. They have often just been written one by one, and a load of two entries would wait for the
  // stores.
  const double x0 = R(0, 0), x1 = R(1, 0), x2 = R(2, 0);
  const double y0 = R(0, 1), y1 = R(1, 1), y2 = R(2, 1);
  const double z0 = R(0, 2), z1 = R(1, 2), z2 = R(2, 2);
  const double x_length = std::abs(x0 * x0 + x1 * x1 + x2 * x2 - 1);
  const double y_length = std::abs(y0 * y0 + y1 * y1 + y2 * y2 - 1);
  const double angle = std::abs(x0 * y0 + x1 * y1 + x2 * y2);
  const double skew0 = std::abs(x1 * y2 - x2 * y1 - z0);
  const double skew1 = std::abs(x2 * y0 - x0 * y2 - z1);
  const double skew2 = std::abs(x0 * y1 - x1 * y0 - z2);
  return (x_length + y_length) + (angle + skew0) + (skew1 + skew2);
}

/// Whether queries take a matrix as a rotation, with an error of at most 1e-5. Every rotation in single precision passes. A matrix
/// that noticeably scales, shears or reflects does not. The largest entry is tested first, because squares out of range would raise
/// floating-point exceptions.
inline bool is_rotation(const Eigen::Matrix3d& R) { return all_within(R, 2) && rotation_error(R) <= 1e-5; }

/// Whether a pose can be computed with: its numbers are in range, and its matrix is a rotation.
inline bool is_usable(const Pose& pose) { return all_within(pose.position, kFarthest) && is_rotation(pose.rotation); }

/// Whether both poses of a query can be computed with.
inline bool has_usable_poses(const ProximityQuery& query) {
  return query.poses_are_usable || (is_usable(*query.pose1) && is_usable(*query.pose2));
}

/// Whether queries start from a normal: it is a unit vector to 1e-6. The entries are tested first, because squares and sums of
/// numbers out of range would raise floating-point exceptions.
inline bool is_usable(const Eigen::Vector3d& normal) { return all_within(normal, 2) && std::abs(normal.squaredNorm() - 1) < 1e-6; }

}  // namespace supernormal
