// The angle of repose of a heap.
#pragma once

#include <array>
#include <cstddef>

#include "model/geometry.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// The section of a heap's flank that is measured, as fractions of the base's radius: without the rounded top and the foot.
constexpr double kFlankFrom = 0.25;
constexpr double kFlankTo = 0.85;

struct Heap {
  double angle;           ///< degrees, of repose: between flank and horizontal, mean of the sectors
  double standard_error;  ///< degrees, from the scatter of the sectors
  double height;          ///< m, of the straight flank at the axis, above the base
  std::size_t grains;     ///< number of grains with centres above the base
  bool has_flank;         ///< whether a grain lies where the flank is measured; otherwise there is no angle and no height
};

/// Measures the heap on a horizontal, round base. Vertical rays find the surface. The mean height on each arc of a sector is fitted
/// by a straight line in the distance from the axis. `centre` and `radius` of the base are in m.
Heap measure_heap(const World& world, const Point& centre, double radius);

}  // namespace falling_particles
