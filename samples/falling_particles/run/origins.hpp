// Where the grains of a scene come from, and what is around them there.
#pragma once

#include <string>
#include <vector>

#include "model/scene.hpp"

namespace falling_particles {

/// Sentences about grains of the start and of feeders that come behind meshes, above nothing, or where there is no room for them.
std::vector<std::string> doubts_about_origins(const Scene& scene);

}  // namespace falling_particles
