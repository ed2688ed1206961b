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
#include "observe/discharge.hpp"
#include "observe/energy.hpp"
#include "observe/heap.hpp"
#include "observe/measuring.hpp"
#include "observe/overlap.hpp"
#include "observe/sizes.hpp"
#include "world/bonds.hpp"
#include "world/compression.hpp"
#include "world/population.hpp"
#include "world/stepper.hpp"

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
  bool interrupted;  ///< before the end of the scene
  int steps;
  double simulated_seconds;
  double real_seconds;  ///< s, of the steps and their output, without the measurements at the end
  const StepCosts& costs;
  snStatistics statistics;  ///< counts of the steps
  Axis sweep_axis;
  std::size_t contacts_at_end;
  double deepest_contact;         ///< m, over all steps
  double kinetic_height;          ///< m
  double largest_kinetic_energy;  ///< J, of a single grain
  const EnergyWatch& energy;
  Overlap overlap;
  std::size_t outside;             ///< grains outside at the end
  std::size_t leaked;              ///< grains that have been outside at any time
  std::optional<Bed> bed;          ///< for a box
  const Discharge* discharge;      ///< for a hopper, otherwise null
  std::optional<Packing> packing;  ///< for a compression
  std::optional<Heap> heap;        ///< for a hopper's dish
  std::vector<supernormal::effects::Cost> effects;
  std::vector<MeasurementCost> measurements = {};
  double seconds_of_contacts = 0;  ///< s, to gather contacts for the measurements
  std::vector<DrawnSizes> sizes = {};
  const Population* population = nullptr;  ///< null unless grains are inserted or removed
  CheckpointCost checkpoints = {};
  const Bonds* bonds = nullptr;  ///< null unless the scene has bonds
};

/// Whether the summary has the times of the run. Only these depend on the machine and on when the run was stopped.
enum class Times { Told, LeftOut };

/// Writes TOML with units and definitions in comments.
std::string to_toml(const Summary& summary, Times times);

}  // namespace falling_particles
