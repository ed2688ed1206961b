// Points, rectangles and meshes of containers.
#pragma once

#include <array>
#include <vector>

namespace falling_particles {

using Point = std::array<double, 3>;  ///< m

/// A rectangle in the xy-plane with sides along x and y.
struct Rectangle {
  std::array<double, 2> corner;  ///< m, the corner with the lowest x and y
  std::array<double, 2> width;   ///< m, along x and y

  /// The border is not inside.
  bool contains(double x, double y) const {
    return x > corner[0] && x < corner[0] + width[0] && y > corner[1] && y < corner[1] + width[1];
  }
};

/// A single-sided triangle mesh. Grains are on the side from which the vertices of a triangle run anticlockwise.
struct Mesh {
  std::vector<std::array<float, 3>> vertices;          ///< m; ODE keeps meshes in single precision
  std::vector<std::array<unsigned int, 3>> triangles;  ///< indices of vertices
};

}  // namespace falling_particles
