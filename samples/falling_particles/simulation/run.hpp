// The simulation of a scene from start to end.
#pragma once

#include <filesystem>
#include <vector>

#include "output/rendering.hpp"
#include "scene/scene.hpp"

namespace falling_particles {

struct RunEnd {
  bool interrupted;
  bool leaked;                        ///< whether a grain was outside the container at some time
  std::filesystem::path folder;       ///< of the results
  std::vector<Rendering> renderings;  ///< pictures that are still to be made in it
};

/// Simulates the scene, looking for contacts on `threads` (0: as many as the machine has), and writes `out`/<scene>/; prints the
/// summary to stdout, warnings to stderr and, unless quiet, progress too.
RunEnd run(const Scene& scene, const std::filesystem::path& out, bool quiet, int threads);

}  // namespace falling_particles
