// The sizes of a scene's grains.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "world/world.hpp"

namespace falling_particles {

/// The sieve sizes (GrainKind::sieve_size) of the grains of one kind, as they were drawn.
struct DrawnSizes {
  std::string kind;
  std::size_t number = 0;
  double mass = 0;                  ///< kg, of all
  double mean = 0;                  ///< m, by number
  double standard_deviation = 0;    ///< m, by number
  double smallest = 0;              ///< m
  double largest = 0;               ///< m
  double median = 0;                ///< m, by number
  std::array<double, 3> by_mass{};  ///< m: d10, d50 and d90, below which a tenth, half and nine tenths of the mass are
};

/// Of the kinds that have a distribution of sizes.
std::vector<DrawnSizes> measure_sizes(const World& world, const Scene& scene);

}  // namespace falling_particles
