// The simulation of a scene from start to end.
#pragma once

#include <filesystem>
#include <vector>

#include "model/scene.hpp"
#include "output/rendering.hpp"

namespace falling_particles {

struct RunOptions {
  std::filesystem::path out = "out";  ///< folder of the folder of the results
  int threads = 0;                    ///< that look for contacts; 0: as many as the machine has
  bool quiet = false;                 ///< no progress on stderr
  int checkpoint_every = 0;           ///< steps; 0: no checkpoints, or as the run that is gone on with
  bool resume = false;                ///< goes on from the checkpoint of a run that was killed, if there is one
};

struct RunEnd {
  bool interrupted;
  bool leaked;                        ///< whether a grain was outside the container at some time
  std::filesystem::path folder;       ///< of the results
  std::vector<Rendering> renderings;  ///< pictures that are still to be made in it
};

/// Simulates the scene and writes `out`/<scene>/; prints the summary to stdout, warnings to stderr and, unless quiet, progress too.
/// An interrupt (interrupt.hpp) ends it with results up to then, or with checkpoints at the next one, to go on from there.
RunEnd run(const Scene& scene, const RunOptions& options);

}  // namespace falling_particles
