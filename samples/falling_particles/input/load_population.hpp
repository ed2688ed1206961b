// Reads feeders and sinks from a scene file.
#pragma once

#include <vector>

#include "base/toml_input.hpp"
#include "model/feeder.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// Reads the sections [[feeder]]. The scene's container, grains and time must have been read. Throws InputError.
std::vector<Feeder> load_feeders(const TomlTable& root, const Scene& scene);

/// Reads the sections [[sink]]. Throws InputError.
std::vector<Sink> load_sinks(const TomlTable& root, const Scene& scene);

}  // namespace falling_particles
