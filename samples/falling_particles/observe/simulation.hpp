// The state of a simulation.
#pragma once

#include <supernormal/supernormal.h>

#include <optional>
#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "common/random.hpp"
#include "discharge.hpp"
#include "energy.hpp"
#include "leaks.hpp"
#include "model/scene.hpp"
#include "world/periodic_cell.hpp"
#include "world/population.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// The monitors that run after every step. Their arguments must outlive them.
struct Watches {
  Watches(World& world, const Scene& scene, Random& random);
  void after_step(double time, const Stepper& stepper);

  /// The compressor has no state from step to step.
  void serialize(auto& archive) {
    archive(leaks, energy);
    if (discharge) archive(*discharge);
  }

  LeakWatch leaks;
  EnergyWatch energy;
  std::optional<Discharge> discharge;    ///< for a hopper
  std::optional<Compressor> compressor;  ///< for a periodic container
};

/// The simulation of a scene, from its start or from a saved state. Two simulations continue alike only if both start from the same
/// saved state, because World::save does not save everything. A thread can have only one simulation at a time, since ODE's random
/// numbers and Supernormal's counts are global to the thread or the process.
class Simulation {
 public:
  /// Finds contacts on `threads` (0: as many as the machine has). The scene must outlive this object.
  Simulation(const Scene& scene, int threads);
  /// Resumes the same scene from the result of save().
  Simulation(const Scene& scene, int threads, const std::string& saved);

  /// Takes the step that ends at `now` (s), as a run without files does.
  void advance(double now);

  /// Call it between two steps.
  std::string save() const { return save_for(world.scene().effects); }
  /// The same for a simulation with other effects. The work for effects that it lacks is forgotten.
  std::string save_for(const std::vector<supernormal::effects::Effect>& effects) const;

  /// Of all steps since the start.
  snStatistics statistics() const;
  std::vector<supernormal::effects::Cost> effect_costs() const;

  Random random;
  World world;
  Stepper stepper;
  Watches watches;
  Population population;

 private:
  struct Saved;
  Simulation(const Scene& scene, int threads, Saved&& saved);

  // Counts up to the saved state.
  snStatistics statistics_before_{};
  std::vector<supernormal::effects::Cost> effect_costs_before_;
};

}  // namespace falling_particles
