// Reads the [periodic] section of a scene file.
#pragma once

#include "base/toml_input.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// Reads along which axes a scene repeats, of which the container, the parts and the grains have been read, and takes away the
/// parts of the container that close it there. Throws InputError, also when a part is not the same all along such an axis.
void load_periodic(const TomlTable& root, Scene& scene);

}  // namespace falling_particles
