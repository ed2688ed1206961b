// The cost of each digit: every method swept over its own accuracy.
#pragma once

#include <cstdint>

#include "atlas.hpp"
#include "measurement.hpp"

namespace accuracy_cost {

/// Measures all solvers at all their tolerances, in a task for each class of bodies and situation, each with `pairs` pairs.
Part query_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort);

/// Measures the methods of the literature beside our solvers, likewise.
Part literature_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort);

/// Measures ODE's dConvex and dTriMesh over their number of vertices beside our solver, likewise.
Part mesh_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort);

}  // namespace accuracy_cost
