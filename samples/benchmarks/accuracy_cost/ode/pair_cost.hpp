// Measures dCollide of two of our bodies beside libccd.
#pragma once

#include <cstdint>
#include <ostream>

#include "measurement.hpp"

namespace accuracy_cost {

/// Writes a Markdown table: dCollide without a warm start and with room for one contact, beside libccd GJK+EPA with the same
/// support functions, on the same random pairs. `pairs`: of each class and situation.
void write_pair_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort, std::ostream& out);

}  // namespace accuracy_cost
