// The input and output of a query of a body and a triangle surface.
#pragma once

#include <algorithm>
#include <array>

#include "shapes/validation.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

struct MeshTriangle {
  std::array<Vector3, 3> vertices;  ///< m, world frame; counter-clockwise seen from outside
  int index = 0;                    ///< the caller's name for the triangle
};

/// Whether the coordinates can be computed with: finite and within kMaxLength.
inline bool is_usable(const MeshTriangle& triangle) {
  return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                     [](const Vector3& vertex) { return (vertex.array().abs() <= kMaxLength).all(); });
}

struct MeshContact {
  Proximity proximity;  ///< world frame; body 1 is the body, body 2 the surface
  int triangle = 0;     ///< MeshTriangle::index
};

}  // namespace supernormal
