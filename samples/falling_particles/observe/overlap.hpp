// The overlaps of grains with one another and with walls.
#pragma once

#include <cstddef>

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

struct Overlap {
  double depth = 0;             ///< m, of the deepest of all pairs, walls included; 0 when nothing overlaps
  double relative_to_pair = 0;  ///< the largest of depth / smallest half-axis of the pair's grains
  std::size_t pairs = 0;        ///< number of pairs that overlap
};

/// Measures every pair whose bounding boxes meet (others cannot overlap), by snGeomProximity.
Overlap measure_overlap(const World& world);

/// The number of grains whose centre is beyond a wall or the floor, or not a number, and in no sink.
std::size_t count_outside(const World& world, const Scene& scene);

}  // namespace falling_particles
