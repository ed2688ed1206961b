// Pairs of superellipsoids of a kind, and the time of several ways of asking them: for benchmarks, and for pairs in lanes.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <ctime>
#include <limits>
#include <memory>
#include <vector>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"

namespace drawn_pairs {

using supernormal::Matrix3;
using supernormal::Pose;
using supernormal::Shape;
using supernormal::Vector3;

class Draw : public supernormal::test::Draw {
 public:
  using supernormal::test::Draw::Draw;

  /// Of random exponents, or an ellipsoid if both limits are the same.
  std::unique_ptr<Shape> shape(const Vector3& half_axes, double least_exponent, double largest_exponent) {
    if (least_exponent == largest_exponent) return std::make_unique<supernormal::Ellipsoid>(half_axes);
    const double delta = uniform(least_exponent, largest_exponent);
    return std::make_unique<supernormal::Superellipsoid>(half_axes, delta, uniform(least_exponent, largest_exponent));
  }

  /// Random poses. At a random normal the witness points have the gap, in units of the smallest half-extent.
  void place(const Shape& shape1, Pose& pose1, const Shape& shape2, Pose& pose2, double gap) {
    pose1 = {within(-10, 10), rotation()};
    pose2.rotation = rotation();
    const Vector3 n = direction();
    const double unit = std::min(shape1.half_extents().minCoeff(), shape2.half_extents().minCoeff());
    pose2.position = pose1.position + pose1.rotation * shape1.point(pose1.rotation.transpose() * n) -
                     pose2.rotation * shape2.point(-(pose2.rotation.transpose() * n)) + gap * unit * n;
  }

  /// The faces across z on one another with the gap (m), at a random place and angle. They are not level, so s at their normal is
  /// below the largest.
  void lay_on_face(const Shape& shape1, const Pose& pose1, const Shape& shape2, Pose& pose2, double gap) {
    const double height = shape1.half_extents().z() + shape2.half_extents().z() + gap;
    pose2.rotation = Eigen::AngleAxisd(uniform(-3.14, 3.14), pose1.rotation.col(2)) * pose1.rotation;
    const double y = uniform(-0.5, 0.5), x = uniform(-0.5, 0.5);
    pose2.position = pose1.position + pose1.rotation * Vector3(x, y, height);
  }

  /// The common normal, in the frame of body 1, of the pose a step before: 1e-3 units and 1 mrad away.
  Vector3 earlier_normal(const Shape& shape1, const Pose& pose1, const Shape& shape2, Pose pose2, double unit) {
    pose2.position += 1e-3 * unit * direction();
    pose2.rotation = Eigen::AngleAxisd(1e-3, direction()).toRotationMatrix() * pose2.rotation;
    return pose1.rotation.transpose() * supernormal::find_proximity(shape1, pose1, shape2, pose2).normal;
  }
};

/// s of this thread's processor time
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// s; the least time of each of the `count` ways, `ask(way)`, over rounds in which they take turns.
template <typename Ask>
std::vector<double> least_seconds(std::size_t count, int rounds, const Ask& ask) {
  std::vector<double> least(count, std::numeric_limits<double>::infinity());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t way = 0; way < count; ++way) {
      const double start = processor_seconds();
      ask(way);
      least[way] = std::min(least[way], processor_seconds() - start);
    }
  }
  return least;
}

}  // namespace drawn_pairs
