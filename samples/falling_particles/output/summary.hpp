// The summary of a run.
#pragma once

#include <supernormal/supernormal.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/stopwatch.hpp"
#include "model/scene.hpp"
#include "observe/bed.hpp"
#include "observe/energy.hpp"
#include "observe/measuring.hpp"
#include "observe/simulation.hpp"

namespace falling_particles {

inline constexpr std::string_view kSummaryFile = "summary.toml";

/// A bed is settled if its kinetic energy would lift it by less than this fraction of the smallest half-axis.
constexpr double kSettledHeight = 1e-3;

struct CheckpointCost {
  unsigned long long number = 0;
  Stopwatch watch = {};  ///< to write them and to resume from them
};

/// The work and the results of a run.
struct Summary {
  const Scene& scene;
  const Simulation& simulation;
  bool interrupted;  ///< before the end of the scene
  int steps;
  double real_seconds;      ///< s, of the steps and their output, without the measurements at the end
  snStatistics statistics;  ///< counts of the steps
  Overlap overlap;
  std::size_t outside;       ///< grains outside at the end
  std::optional<Bed> bed;    ///< for a box
  std::optional<Heap> heap;  ///< for a hopper's dish
  std::vector<DrawnSizes> sizes;
  std::vector<MeasurementCost> measurements;
  double seconds_of_contacts;  ///< s, to gather contacts for the measurements
  CheckpointCost checkpoints;
};

/// Whether the summary has the times of the run. Only these depend on the machine and on when the run was stopped.
enum class Times { Told, LeftOut };

/// Writes TOML with units and definitions in comments.
std::string to_toml(const Summary& summary, Times times);

}  // namespace falling_particles
