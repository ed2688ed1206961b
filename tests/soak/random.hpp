// Random numbers of a sample. They depend only on the seed and the sample's number, on every machine.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::soak {

/// SplitMix64 (Steele, Lea, Flood 2014). It starts at once, which matters because every sample has its own generator.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t sample) : state_(mixed(seed + kStep) ^ mixed(sample * kStep + 1)) {}

  std::uint64_t next() { return mixed(state_ += kStep); }

  /// A number in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }

  /// A number in 0 ... end - 1. Its bias of end/2^64 is negligible.
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(next() % end); }

  bool chance(double probability) { return uniform() < probability; }

  /// A direction, uniform over the sphere.
  Vector3 direction() {
    const double z = uniform(-1, 1), angle = 2 * std::numbers::pi * uniform();
    const double across = std::sqrt(1 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
  }

  /// A rotation, uniform over all rotations (Shoemake 1992).
  Matrix3 rotation() {
    const double share = uniform(), angle1 = 2 * std::numbers::pi * uniform(), angle2 = 2 * std::numbers::pi * uniform();
    const double small = std::sqrt(1 - share), large = std::sqrt(share);
    return Eigen::Quaterniond(large * std::cos(angle2), small * std::sin(angle1), small * std::cos(angle1),
                              large * std::sin(angle2))
        .toRotationMatrix();
  }

  /// A rotation by `angle` about a random axis.
  Matrix3 turn(double angle) { return Eigen::AngleAxisd(angle, direction()).toRotationMatrix(); }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;

  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111eb;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_;
};

}  // namespace supernormal::soak
