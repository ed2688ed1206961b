// Two grains of a run, in the poses of its trajectory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pair/pair.hpp"

namespace explain_pair {

/// Selects grains of a run.
struct Recording {
  std::string scene_path;                   ///< the scene file of the run
  std::string trajectory_path;              ///< its trajectory.csv
  double time;                              ///< s; of a frame
  std::size_t first;                        ///< index of a body
  std::optional<std::size_t> second;        ///< index of the other body; empty: the body with the smallest gap
  std::vector<std::string> overrides = {};  ///< the --set options of the run
};

/// The pair, in the frame of the run. Throws falling_particles::InputError.
Pair recorded_pair(const Recording& recording);

}  // namespace explain_pair
