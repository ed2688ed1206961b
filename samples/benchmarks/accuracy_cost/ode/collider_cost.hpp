// What dCollide costs: our bodies against every class of ODE, and ODE's own bodies of the same size in their place.
#pragma once

#include <cstdint>
#include <ostream>

#include "measurement.hpp"

namespace accuracy_cost {

/// Places every body at every collider `poses` times, 2 % overlapping and 2 % apart, times dCollide, and writes tables in Markdown
/// of the medians, their ratios and the numbers of contacts. Bodies take turns on each pose, so that whatever slows the machine
/// down slows all of them. A query follows one of a pose 1e-3 (m and rad) away, as in a simulation: a warm start is worth there
/// what it is worth.
void write_collider_costs(std::size_t poses, std::uint64_t seed, const Effort& effort, std::ostream& out);

}  // namespace accuracy_cost
