// The monitors of a run.
#pragma once

#include <optional>

#include "base/random.hpp"
#include "discharge.hpp"
#include "energy.hpp"
#include "leaks.hpp"
#include "model/scene.hpp"
#include "world/compression.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// The monitors that run after every step. Their arguments must outlive them.
struct Watches {
  Watches(World& world, const Scene& scene, Random& random);
  void after_step(double time, const Stepper& stepper) {
    leaks.after_step(time);
    energy.after_step();
    if (discharge) discharge->after_step(time);
    if (compressor) compressor->after_step(time, stepper.contact_geoms());
  }

  /// The compressor has no state from step to step.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(leaks, energy);
    if (discharge) archive(*discharge);
  }

  LeakWatch leaks;
  EnergyWatch energy;
  std::optional<Discharge> discharge;    ///< for a hopper
  std::optional<Compressor> compressor;  ///< for a periodic container
};

}  // namespace falling_particles
