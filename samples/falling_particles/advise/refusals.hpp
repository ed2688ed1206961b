// Scenes that are loaded, but cannot run.
#pragma once

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// Throws InputError if the start of a scene is bad by one of the checks below.
void refuse_bad_start(const Scene& scene);

/// Throws InputError if bonds are too stiff for the step and this number of iterations of the solver. The scene has bonds. The
/// world may have made steps.
void refuse_stiff_bonds(const World& world, int iterations);

// Each throws InputError, and is in a file of its own. A world is at its start.

/// If two walls, between which a servo acts, meet by their motions.
void refuse_meetings(const Scene& scene);

/// If the grains of a state overlap one another or walls by more than StartState::overlap, or are outside the container.
void refuse_bad_state(const World& world);

/// If a section [[bond]] bonds nothing, or if its bonds are too stiff. The scene has bonds.
void refuse_bad_bonds(const World& world);

/// If a free wall overlaps another wall, beside a state by more than StartState::overlap. Both would be pushed apart.
void refuse_bad_flights(const World& world);

}  // namespace falling_particles
