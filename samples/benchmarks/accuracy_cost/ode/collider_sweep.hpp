// The cost of accuracy in comparison with ODE's own classes.
#pragma once

#include <cstdint>

#include "atlas.hpp"
#include "measurement.hpp"

namespace accuracy_cost {

/// A superellipsoid overlaps a collider by 2 %, ours at all tolerances and as polyhedra of growing vertex count. Measures the
/// time of a dCollide and the error of its depth, in one task for each collider, with `poses` poses.
Part collider_sweep(std::size_t poses, std::uint64_t seed, const Effort& effort);

}  // namespace accuracy_cost
