// Triangle meshes from files.
#pragma once

#include <string>

#include "model/geometry.hpp"

namespace falling_particles {

/// Whether this build can read meshes: it then has assimp.
bool can_load_meshes();

/// The triangles of an STL or OBJ file, whose lengths are in units of `unit` m; vertices in the same place are one. Throws
/// std::runtime_error, which names the file and what is wrong with it.
Mesh load_mesh(const std::string& path, double unit);

}  // namespace falling_particles
