// The angle of repose of a heap.
#pragma once

#include <array>
#include <cstddef>

#include "model/geometry.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// The part of a heap's flank that is measured, in shares of its base's radius: without the rounded top and the foot.
constexpr double kFlankFrom = 0.25;
constexpr double kFlankTo = 0.85;

struct Heap {
  double angle;           ///< degrees, of repose: between flank and horizontal, mean of the sectors
  double standard_error;  ///< degrees, from the scatter of the sectors
  double height;          ///< m, at the axis, of the straight flank above the base
  std::size_t grains;     ///< number of grains whose centre is above the base
  bool has_flank;         ///< whether a grain lies where the flank is measured; without one there is no angle and no height
};

/// Measures the heap on a horizontal, round base: vertical rays find the surface, and the mean height on each of a sector's arcs
/// is fitted by a straight line in the distance from the axis. `centre` and `radius` of the base are in m.
Heap measure_heap(const World& world, const Point& centre, double radius);

}  // namespace falling_particles
