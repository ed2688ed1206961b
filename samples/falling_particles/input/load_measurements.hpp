// The sections [[measurement]] of a scene file.
#pragma once

#include <vector>

#include "base/toml_input.hpp"
#include "model/request.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// Reads the sections [[measurement]]. The scene's container, grains and time must have been read. Throws InputError.
std::vector<MeasurementRequest> load_measurements(const TomlTable& root, const Scene& scene);

}  // namespace falling_particles
