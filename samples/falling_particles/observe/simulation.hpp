// All that changes while a scene is simulated.
#pragma once

#include <supernormal/supernormal.h>

#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "base/random.hpp"
#include "model/scene.hpp"
#include "watches.hpp"
#include "world/population.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// A scene on its way, from its start or from where another object has saved it. The two go on alike only if both are loaded from
/// what was saved: what a world remembers beyond its state (World::save) is new in both. There can be one at a time in a thread,
/// since ODE's random numbers and Supernormal's counts are the thread's or the process'.
class Simulation {
 public:
  /// Looks for contacts on `threads` (0: as many as the machine has). The scene must outlive this object.
  Simulation(const Scene& scene, int threads);
  /// Goes on with the same scene from what save() has returned.
  Simulation(const Scene& scene, int threads, const std::string& saved);

  /// Between two steps.
  std::string save() const;

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

  // Counts up to where the run was saved.
  snStatistics statistics_before_{};
  std::vector<supernormal::effects::Cost> effect_costs_before_;
};

}  // namespace falling_particles
