// What the benchmarks of drawn pairs have in common: the draw of shapes and poses, and the time of several ways of asking.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <ctime>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace drawn_pairs {

using supernormal::Matrix3;
using supernormal::Pose;
using supernormal::Shape;
using supernormal::Vector3;

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vector3 direction() { return Vector3{gauss_(engine_), gauss_(engine_), gauss_(engine_)}.normalized(); }
  Vector3 within(double low, double high) { return Vector3{uniform(low, high), uniform(low, high), uniform(low, high)}; }
  Matrix3 rotation() {
    return Eigen::Quaterniond(Eigen::Vector4d{gauss_(engine_), gauss_(engine_), gauss_(engine_), gauss_(engine_)})
        .normalized()
        .toRotationMatrix();
  }

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

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> gauss_;
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
