// Triangle meshes, also from files.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace common {

/// A single-sided triangle mesh. Bodies are on the side from which the vertices of a triangle run anticlockwise.
struct Mesh {
  std::vector<std::array<float, 3>> vertices;          ///< m; ODE keeps meshes in single precision
  std::vector<std::array<unsigned int, 3>> triangles;  ///< indices of vertices
};

/// Whether this build can read meshes, which needs assimp.
bool can_load_meshes();

/// Reads the triangles of an STL or OBJ file, whose lengths are in units of `unit` m. Equal vertices are merged. Throws
/// std::runtime_error with the file and the mistake.
Mesh load_mesh(const std::string& path, double unit);

}  // namespace common
