// Validation of triangles.
#pragma once

#include <algorithm>

#include "shapes/validation.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace supernormal {

/// Whether the coordinates are finite and within kMaxLength.
inline bool is_usable(const MeshTriangle& triangle) {
  return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                     [](const Vector3& vertex) { return (vertex.array().abs() <= kMaxLength).all(); });
}

}  // namespace supernormal
