// Doubts about the positions at which the grains of a scene start.
#pragma once

#include <string>
#include <vector>

#include "model/scene.hpp"

namespace falling_particles {

/// Sentences about grains of the start and of feeders that start behind meshes, above nothing, or where there is no space for them.
std::vector<std::string> doubts_about_origins(const Scene& scene);

}  // namespace falling_particles
