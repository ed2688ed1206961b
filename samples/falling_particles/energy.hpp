#pragma once

#include "scene.hpp"
#include "world.hpp"

namespace falling_particles {

struct Energy {
  double kinetic;    ///< J, of translation and rotation
  double potential;  ///< J, in the scene's gravity, 0 at the origin
  double total() const { return kinetic + potential; }
};

Energy measure_energy(const World& world, const Scene& scene);

/// The height, m, to which the kinetic energy would lift all grains together; 0 without gravity.
double kinetic_height(const World& world, const Scene& scene);

}  // namespace falling_particles
