// The samples of the soak.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "supernormal/proximity/proximity.hpp"
#include "support/hard_cases/catalogue.hpp"
#include "support/superellipsoid_classes.hpp"

namespace supernormal::soak {

/// Random numbers of a sample. They depend only on the seed and the sample's number, on every machine. SplitMix64 (Steele, Lea,
/// Flood 2014). It starts at once, which matters because every sample has its own generator.
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

struct Sample {
  samples::HardCase pair;  ///< the name says its origin
  Settings settings;
  /// m; the value of the gap function at the normal at which the bodies were placed. From 0 on it is the gap. Below 0 the gap is
  /// not less.
  std::optional<double> placed_gap;
};

/// The sources of samples.
enum class Mix {
  Everything,
  Sharp,  ///< only random pairs with exponents of any classes, sharp beside flat, where most faults have been found
};

/// Draws samples. Of the whole mix, half are from the catalogue of hard cases, with small or large changes. Half are random pairs
/// of bodies of a class (the classes of tests/data/superellipsoid_pairs.csv, and the other shapes), from apart to one inside the
/// other.
class SampleSource {
 public:
  explicit SampleSource(std::uint64_t seed, Mix mix = Mix::Everything);

  /// Draws sample number `index`, which depends only on the seed.
  void draw(std::uint64_t index, Sample& sample) const;

  /// The random numbers for the checks of a sample.
  Random random_of_checks(std::uint64_t index) const { return {~seed_, index}; }

 private:
  void draw_from_catalogue(Random& random, Sample& sample) const;

  std::uint64_t seed_;
  Mix mix_;
  std::vector<samples::HardCase> catalogue_;
  std::vector<test::SuperellipsoidClass> classes_;  // classes of random pairs
};

}  // namespace supernormal::soak
