// All ways to ask many pairs at once.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "proximity/lanes/lane_query.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::test {

/// Asks in one kernel. Pairs that no kernel takes are asked alone.
inline void find_in_lanes(std::span<const ProximityQuery> queries, const Settings& settings, const LaneKernel& kernel,
                          std::span<Proximity> answers) {
  LaneBatch batch(settings, kernel, answers);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    if (is_for_lanes(*queries[k].shape1, *queries[k].shape2, settings)) {
      batch.add(queries[k], k);
    } else {
      answers[k] = find_proximity(queries[k], settings);
    }
  }
  batch.solve_rest();
}

struct WayAmongMany {
  std::string name;
  std::function<void(std::span<const ProximityQuery>, const Settings&, std::span<Proximity>)> ask;
};

/// Every kernel that this processor has, and find_proximities().
inline std::vector<WayAmongMany> ways_among_many() {
  std::vector<WayAmongMany> ways;
  for (int k = 0; k < lane_kernels().count; ++k) {
    const LaneKernel& kernel = *lane_kernels().kernels[k];
    ways.push_back({kernel.name, [&kernel](std::span<const ProximityQuery> queries, const Settings& settings,
                                           std::span<Proximity> answers) { find_in_lanes(queries, settings, kernel, answers); }});
  }
  ways.push_back({"find_proximities", find_proximities});
  return ways;
}

}  // namespace supernormal::test
