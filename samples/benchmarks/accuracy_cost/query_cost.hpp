// The cost of each digit: every method over the range of its accuracy parameter.
#pragma once

#include <cstdint>

#include "common/measured_tables.hpp"
#include "measurement.hpp"

namespace accuracy_cost {

/// Measures all solvers at all their tolerances, with a task for each class of bodies and situation, each with `pairs` pairs.
common::MeasuredTable query_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort);

/// The same for the literature methods and our solvers.
common::MeasuredTable literature_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort);

}  // namespace accuracy_cost
