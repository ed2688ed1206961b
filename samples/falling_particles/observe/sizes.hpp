// The size statistics of a scene's grains.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "world/world.hpp"

namespace falling_particles {

/// The sieve sizes (GrainKind::sieve_size) of all grains of one kind so far.
struct DrawnSizes {
  std::string kind;
  std::size_t number = 0;
  double mass = 0;                  ///< kg, of all
  double mean = 0;                  ///< m, by number
  double standard_deviation = 0;    ///< m, by number
  double smallest = 0;              ///< m
  double largest = 0;               ///< m
  double median = 0;                ///< m, by number
  std::array<double, 3> by_mass{};  ///< m: d10, d50 and d90, below which 10, 50 and 90 % of the mass are
};

/// The sizes of the kinds that have a distribution.
std::vector<DrawnSizes> measure_sizes(const World& world, const Scene& scene);

}  // namespace falling_particles
