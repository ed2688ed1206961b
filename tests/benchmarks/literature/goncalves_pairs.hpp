// The random pairs of Goncalves, Bernardino, Jorge and Lopes (2017), drawn as by the generator of their program.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace literature::test {

struct RandomPair {
  supernormal::Superellipsoid shape1, shape2;
  supernormal::Pose pose1, pose2;
};

/// The linear congruential generator of the C standard's example, with 32 bits of state, of which the upper 15 count. Numbers are
/// rounded to single precision, as in their program.
class Generator {
 public:
  /// A multiple of 1/1024 of the range, m or without unit.
  double in_range(double low, double high) { return float_of(low + number() % 1024 / 1024.0 * (high - low)); }

  /// A quaternion of four sums of 16 uniform numbers each, which are almost normally distributed.
  supernormal::Matrix3 rotation() {
    std::array<double, 4> q{};
    for (double& part : q) {
      double sum = 0;
      for (int k = 0; k < 16; ++k) sum += number() % 10240 / 10240.0;
      part = float_of(sum / 16 - 0.5);
    }
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }

  /// Half-axes 0.5...1.5, exponents 2/1.1...2/0.3. Two more numbers are the tapers, which are 0 here.
  supernormal::Superellipsoid superellipsoid() {
    supernormal::Vector3 half_axes;
    for (double& half_axis : half_axes) half_axis = in_range(0.5, 1.5);
    const double delta = 2 / in_range(0.3, 1.1);
    const double epsilon = 2 / in_range(0.3, 1.1);
    for (int k = 0; k < 2; ++k) in_range(-0.4, 0.4);
    return {half_axes, delta, epsilon};
  }

 private:
  static double float_of(double x) { return static_cast<double>(static_cast<float>(x)); }
  int number() {
    state_ = 1103515245U * state_ + 12345U;
    return static_cast<int>((state_ >> 16U) & 0x7fffU);
  }

  std::uint32_t state_ = 1337;
};

/// The first pairs; the centres are 4 m apart.
inline std::vector<RandomPair> goncalves_pairs(int count) {
  Generator generator;
  std::vector<RandomPair> pairs;
  for (int i = 0; i < count; ++i) {
    const supernormal::Superellipsoid shape1 = generator.superellipsoid(), shape2 = generator.superellipsoid();
    const supernormal::Matrix3 rotation1 = generator.rotation(), rotation2 = generator.rotation();
    pairs.push_back({shape1, shape2, {supernormal::Vector3::Zero(), rotation1}, {supernormal::Vector3(4, 0, 0), rotation2}});
  }
  return pairs;
}

}  // namespace literature::test
