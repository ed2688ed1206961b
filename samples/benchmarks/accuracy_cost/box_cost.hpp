// Bounding boxes: what a tight one costs, and what a loose one costs in pairs.
#pragma once

#include <cstdint>

#include "atlas.hpp"
#include "measurement.hpp"

namespace accuracy_cost {

/// Measures, for each class of bodies, the ways to a box along the axes of the world on `bodies` bodies in random orientations: the
/// time, the volume over that of the smallest box, and the pairs that overlapping boxes leave to the narrow phase when the bodies
/// fill 60 % of a cube.
Part box_costs(std::size_t bodies, std::uint64_t seed, const Effort& effort);

}  // namespace accuracy_cost
