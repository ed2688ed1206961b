// Triangle meshes from files.
#pragma once

#include <string>

#include "common/mesh.hpp"

namespace common {

/// Whether this build can read meshes, which needs assimp.
bool can_load_meshes();

/// Reads the triangles of an STL or OBJ file, whose lengths are in units of `unit` m. Equal vertices are merged. Throws
/// std::runtime_error with the file and the mistake.
Mesh load_mesh(const std::string& path, double unit);

}  // namespace common
