// The samples of the soak.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "random.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "support/hard_cases/catalogue.hpp"
#include "support/superellipsoid_classes.hpp"

namespace supernormal::soak {

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
