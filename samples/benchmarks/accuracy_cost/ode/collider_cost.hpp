// The cost of dCollide for our bodies against every class of ODE, and for ODE's own bodies of the same size in their place.
#pragma once

#include <cstdint>
#include <ostream>

#include "measurement.hpp"

namespace accuracy_cost {

/// Places every body at every collider `poses` times, 2 % overlapping and 2 % apart, times dCollide, and writes tables in
/// Markdown of the medians, their ratios and the numbers of contacts. Bodies take turns on each pose, so that whatever slows the
/// machine down slows all of them. A query follows one of a pose 1e-3 (m and rad) away, as in a simulation, so that a warm start
/// has its usual effect.
void write_collider_costs(std::size_t poses, std::uint64_t seed, const Effort& effort, std::ostream& out);

}  // namespace accuracy_cost
