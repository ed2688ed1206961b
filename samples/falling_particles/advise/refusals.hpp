// Scenes that are loaded, but cannot run.
#pragma once

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// Throws InputError if the start of a scene is bad: grains overlap parts or, of a state, one another, or are outside the
/// container; bonds bond nothing or are too stiff; a free wall is in another one; walls between which a servo acts meet.
void refuse_bad_start(const Scene& scene);

/// Throws InputError if bonds are too stiff for the step and this number of iterations of the solver. The scene has bonds. The
/// world may have made steps.
void refuse_stiff_bonds(const World& world, int iterations);

}  // namespace falling_particles
