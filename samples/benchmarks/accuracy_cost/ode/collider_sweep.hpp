// What accuracy costs against ODE's own classes.
#pragma once

#include <cstdint>

#include "atlas.hpp"
#include "measurement.hpp"

namespace accuracy_cost {

/// A superellipsoid that overlaps a collider by 2 %, ours at all tolerances and as polyhedra of growing vertex count: the time of a
/// dCollide and the error of its depth. A task for each collider, with `poses` poses.
Part collider_sweep(std::size_t poses, std::uint64_t seed, const Effort& effort);

}  // namespace accuracy_cost
