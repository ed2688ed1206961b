// The cost of dCollide for our bodies with every geometry class of ODE, and for ODE bodies of the same size.
#pragma once

#include <cstdint>
#include <ostream>

#include "measurement.hpp"

namespace accuracy_cost {

/// Places every body at every collider `poses` times, overlapping by 2 % and apart by 2 %, and measures dCollide. Writes Markdown
/// tables of the medians, their ratios and the numbers of contacts. The bodies take turns on each pose, so that a disturbance of
/// the machine affects all of them. Consecutive queries differ by 1e-3 (m and rad), as in a simulation, so a warm start has its
/// usual effect.
void write_collider_costs(std::size_t poses, std::uint64_t seed, const Effort& effort, std::ostream& out);

}  // namespace accuracy_cost
