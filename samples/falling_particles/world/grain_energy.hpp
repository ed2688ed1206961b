// Energies of a grain.
#pragma once

#include "model/scene.hpp"
#include "world.hpp"

namespace falling_particles {

/// J, of translation and rotation.
double kinetic_energy(const Grain& grain);

/// J, kinetic and potential energy; 0 at rest at the origin.
double energy_of(const Grain& grain, const Scene& scene);

}  // namespace falling_particles
