// Reads the [[part]] sections of a scene file.
#pragma once

#include <string>
#include <vector>

#include "base/toml_input.hpp"
#include "model/scene.hpp"
#include "model/wall.hpp"

namespace falling_particles {

/// The walls of the container, then the walls of the [[part]] sections. Mesh files are relative to the scene's folder. Throws
/// InputError.
std::vector<Wall> load_walls(const TomlTable& root, const Scene& scene, const std::string& scene_path);

}  // namespace falling_particles
