// Reads the [[part]] sections of a scene file.
#pragma once

#include <string>
#include <vector>

#include "base/toml_input.hpp"
#include "model/scene.hpp"
#include "model/wall.hpp"

namespace falling_particles {

/// The parts of the container, then those of the [[part]] sections; mesh files are relative to the scene's folder. Throws
/// InputError.
std::vector<Wall> load_walls(const TomlTable& root, const Scene& scene, const std::string& scene_path);

}  // namespace falling_particles
