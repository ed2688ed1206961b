// Values of a scene that may change during its run.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stepwise_run.hpp"

namespace falling_particles {

/// Changes the values KEY of the assignments KEY=VALUE (toml_override.hpp) in a run, from its next step on. `scene` is the scene of
/// the run. `load` loads it again, with the assignments of earlier changes and of this one.
///
/// The sections of effects and [solver] may change as a whole: the run then continues from its saved state, as at a checkpoint.
/// container.rpm of a drum may change, and part[NAME].motion, .drive.force, .torque, .power,
/// .largest_force, .largest_torque, .stress, .damping and .until. A side of a cell is container.SIDE in place of part[NAME]. A
/// motion acts from the time of its change, from the pose that the wall has then. Its axes, points and directions are in the world.
/// Motions that end before are left out.
///
/// Throws InputError for any other key, and for a motion of a wall that stood at the start. The run is then as before.
void change_values(StepwiseRun& run, Scene& scene, const std::vector<std::string>& assignments, const std::function<Scene()>& load);

}  // namespace falling_particles
