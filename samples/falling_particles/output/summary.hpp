#pragma once

#include <supernormal/supernormal.h>

#include <optional>
#include <string>
#include <vector>

#include "measure/bed.hpp"
#include "measure/discharge.hpp"
#include "measure/energy.hpp"
#include "measure/heap.hpp"
#include "measure/overlap.hpp"
#include "scene/scene.hpp"
#include "simulation/compression.hpp"
#include "simulation/stepper.hpp"

namespace falling_particles {

/// The bed counts as settled when its kinetic energy would lift it by less than this share of the smallest half-axis.
constexpr double kSettledHeight = 1e-3;

/// What a run has done and how it ended.
struct Summary {
  const Scene& scene;
  bool interrupted;
  int steps;
  double simulated_seconds;
  double real_seconds;  ///< of the steps and their output; not of the measurements at the end
  const StepCosts& costs;
  snStatistics statistics;  ///< of the steps
  Axis sweep_axis;
  std::size_t contacts_at_end;
  double deepest_contact;         ///< m, of all steps
  double kinetic_height;          ///< m
  double largest_kinetic_energy;  ///< J, of a grain
  const EnergyWatch& energy;
  Overlap overlap;
  std::size_t outside;             ///< at the end
  std::size_t leaked;              ///< at any time
  std::optional<Bed> bed;          ///< of a box
  const Discharge* discharge;      ///< of a hopper, or null
  std::optional<Packing> packing;  ///< of a compression
  std::optional<Heap> heap;        ///< of a hopper's dish
  std::vector<supernormal::effects::Cost> effects;
};

/// As TOML with units and definitions in comments. The [cost] section depends on the machine, the others do not.
std::string to_toml(const Summary& summary);

}  // namespace falling_particles
