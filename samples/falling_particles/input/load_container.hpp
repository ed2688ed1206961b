// Reads the [container] section of a scene file.
#pragma once

#include <array>

#include "base/toml_input.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// Reads the [container] of a scene file. Throws InputError.
Container read_container(const TomlTable& root, const Time& time);

/// Reads `width` = [x, y] (m) of a container with walls along x and y.
std::array<double, 2> read_width(const TomlTable& table);

/// Throws InputError unless the container has space for all grains of the start.
void check_fit(const TomlTable& root, const Scene& scene);

}  // namespace falling_particles
