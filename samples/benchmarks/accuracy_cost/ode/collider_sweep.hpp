// The cost of accuracy, compared with the geometry classes of ODE.
#pragma once

#include <cstdint>

#include "common/measured_tables.hpp"
#include "measurement.hpp"

namespace accuracy_cost {

/// A superellipsoid overlaps a collider by 2 %: ours at all tolerances, and polyhedra with increasing numbers of vertices. Measures
/// the time of dCollide and the error of its depth, in one task for each collider, with `poses` poses.
common::MeasuredTable collider_sweep(std::size_t poses, std::uint64_t seed, const Effort& effort);

}  // namespace accuracy_cost
