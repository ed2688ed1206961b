// Queries of ellipsoids and superellipsoids by the kernels in lanes, and what they leave to the scalar search.
#pragma once

#include <span>

#include "proximity/lanes/pair_query.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Whether a pair goes through the kernels: of ellipsoids and superellipsoids, with the hybrid solver.
bool is_for_lanes(const Shape& shape1, const Shape& shape2, const Settings& settings);

/// The answer of one pair for which is_for_lanes(). The poses are usable, and `first_normal` is too, or null.
Proximity find_in_one_lane(const ProximityQuery& pair, const Settings& settings);

/// The same answers, to the bit, of many pairs. `kernel`: of lane_kernels(). Writes results[k] for pairs[k].
void find_in_lanes(std::span<const ProximityQuery> pairs, const Settings& settings, const LaneKernel& kernel,
                   std::span<Proximity> results);

}  // namespace supernormal
