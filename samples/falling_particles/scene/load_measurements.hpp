// The sections [[measurement]] of a scene file.
#pragma once

#include <vector>

#include "measurements/request.hpp"
#include "scene/scene.hpp"
#include "scene/toml_input.hpp"

namespace falling_particles {

/// The scene's container, grains and time have been read. Throws InputError.
std::vector<MeasurementRequest> load_measurements(const TomlTable& root, const Scene& scene);

}  // namespace falling_particles
