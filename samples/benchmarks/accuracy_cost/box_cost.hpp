// The cost of bounding boxes: the time for a tight box, and the extra pairs of a loose box.
#pragma once

#include <cstdint>

#include "common/measured_tables.hpp"
#include "measurement.hpp"

namespace accuracy_cost {

/// Measures the methods for axis-aligned boxes for each class, on `bodies` bodies in random orientations. Results: the time, the
/// volume relative to the smallest box, and the number of pairs with overlapping boxes when the bodies fill 60 % of a cube.
common::MeasuredTable box_costs(std::size_t bodies, std::uint64_t seed, const Effort& effort);

}  // namespace accuracy_cost
