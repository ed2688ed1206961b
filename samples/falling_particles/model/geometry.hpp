// Points, rectangles and meshes of containers.
#pragma once

#include <array>
#include <vector>

namespace falling_particles {

using Point = std::array<double, 3>;  ///< m

/// An upright rectangle, seen from above.
struct Rectangle {
  std::array<double, 2> corner;  ///< m, the one with the lowest x and y
  std::array<double, 2> width;   ///< m, along x and y

  /// The border is not inside.
  bool contains(double x, double y) const {
    return x > corner[0] && x < corner[0] + width[0] && y > corner[1] && y < corner[1] + width[1];
  }
};

/// A triangle mesh, single-sided: bodies are on the side from which a triangle's corners run anticlockwise.
struct Mesh {
  std::vector<std::array<float, 3>> vertices;          ///< m; ODE keeps meshes in single precision
  std::vector<std::array<unsigned int, 3>> triangles;  ///< corners, as indices of vertices
};

}  // namespace falling_particles
