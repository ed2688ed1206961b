// What the program measures: queries, and dCollide at every class of ODE and beside libccd.
#pragma once

#include <cstdint>
#include <ostream>

#include "common/measured_tables.hpp"
#include "measurement.hpp"

namespace accuracy_cost {

/// Measures all solvers at all their tolerances, with a task for each class of bodies and situation, each with `pairs` pairs.
common::MeasuredTable query_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort);

/// The same for the literature methods and our solvers.
common::MeasuredTable literature_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort);

/// Places every body at every collider `poses` times, overlapping by 2 %, and measures dCollide. Writes a Markdown table of the
/// medians. The bodies take turns on each pose, so that a disturbance of the machine affects all of them. Consecutive queries
/// differ by 1e-3 (m and rad), as in a simulation, so a warm start has its usual effect.
void write_collider_costs(std::size_t poses, std::uint64_t seed, const Effort& effort, std::ostream& out);

/// Writes a Markdown table: dCollide without a warm start and with room for one contact, beside libccd GJK+EPA with the same
/// support functions, on the same random pairs. `pairs`: of each class and situation.
void write_pair_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort, std::ostream& out);

}  // namespace accuracy_cost
