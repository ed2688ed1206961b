// Reads the [periodic] section of a scene file.
#pragma once

#include "base/toml_input.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// Reads the axes along which a scene repeats, and removes the walls of the container that close it there. The scene's container,
/// walls and grains must have been read. Throws InputError, also when a wall is not uniform along such an axis.
void load_periodic(const TomlTable& root, Scene& scene);

}  // namespace falling_particles
