// Triangle meshes.
#pragma once

#include <array>
#include <vector>

namespace common {

/// A single-sided triangle mesh. Bodies are on the side from which the vertices of a triangle run anticlockwise.
struct Mesh {
  std::vector<std::array<float, 3>> vertices;          ///< m; ODE keeps meshes in single precision
  std::vector<std::array<unsigned int, 3>> triangles;  ///< indices of vertices
};

}  // namespace common
