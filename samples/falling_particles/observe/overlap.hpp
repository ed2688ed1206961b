// The overlaps of grains with each other and with walls.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>

#include "world/world.hpp"

namespace falling_particles {

struct Overlap {
  double depth = 0;                   ///< m, of the deepest pair, walls included; 0 when nothing overlaps
  double relative_to_pair = 0;        ///< largest depth / smallest half-axis of the pair's grains
  std::size_t pairs = 0;              ///< number of pairs that overlap
  std::array<dGeomID, 2> worst = {};  ///< the pair of relative_to_pair; both null when nothing overlaps
  double worst_depth = 0;             ///< m, of this pair
};

/// Measures every pair whose bounding boxes meet, by snGeomProximity. Other pairs cannot overlap. The images of a periodic world
/// must be in place.
Overlap measure_overlap(const World& world);

/// The number of grains that are not Inside.
std::size_t count_outside(const World& world);

}  // namespace falling_particles
