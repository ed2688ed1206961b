// Two grains of a run, as its trajectory left them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pair/pair.hpp"

namespace explain_pair {

/// Which grains of a run.
struct Recording {
  std::string scene_path;                   ///< the scene file that was run
  std::string trajectory_path;              ///< its trajectory.csv
  double time;                              ///< s; of a frame
  std::size_t first;                        ///< index of a body
  std::optional<std::size_t> second;        ///< of the other; the body nearest to the first, or deepest in it, if empty
  std::vector<std::string> overrides = {};  ///< what the run was given with --set
};

/// Throws falling_particles::InputError. The two grains are in the frame of the run.
Pair recorded_pair(const Recording& recording);

}  // namespace explain_pair
