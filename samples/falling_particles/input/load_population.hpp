// Feeders and sinks from a scene file.
#pragma once

#include <vector>

#include "base/toml_input.hpp"
#include "model/feeder.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// The sections [[feeder]] of a scene of which the container, the grains and the time have been read. Throws InputError.
std::vector<Feeder> load_feeders(const TomlTable& root, const Scene& scene);

/// The sections [[sink]]. Throws InputError.
std::vector<Sink> load_sinks(const TomlTable& root, const Scene& scene);

}  // namespace falling_particles
