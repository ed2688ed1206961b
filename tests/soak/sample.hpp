// The samples of the soak program.
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
  samples::HardCase pair;  ///< the name says where it comes from
  Settings settings;
  /// m; the value of the gap function at a normal that the bodies were placed on: at or above zero this is the gap, below zero
  /// the gap is not less.
  std::optional<double> placed_gap;
};

/// The sources that samples are drawn from.
enum class Mix {
  Everything,
  Sharp,  ///< random pairs with exponents of any classes alone, sharp beside flat: where faults have been found most often
};

/// Draws samples: of everything, half from the catalogue of hard cases, changed slightly or considerably, half random pairs of
/// bodies of a class (those of tests/data/superellipsoid_pairs.csv, and the other shapes), from apart to one within the other.
class SampleSource {
 public:
  explicit SampleSource(std::uint64_t seed, Mix mix = Mix::Everything);

  /// Draws sample number `index`, which is always the same for a seed.
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
