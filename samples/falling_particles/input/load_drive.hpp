// Reads the [part.drive] of a wall.
#pragma once

#include <optional>

#include "base/toml_input.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// Reads `drive` of a part, if it has one. The part's shape, pose and motions must have been read. A plane pushes along its normal
/// unless the drive has an axis. A servo without an area is between the walls of `between`, or those that load_servos() reads if
/// there are none. Throws InputError.
std::optional<Drive> read_drive(const TomlTable& part, const Wall& wall, const std::vector<FacingWalls>& between);

/// Reads the walls between which servos are. All walls of the scene must have been read. Throws InputError.
void load_servos(const TomlTable& root, Scene& scene);

}  // namespace falling_particles
