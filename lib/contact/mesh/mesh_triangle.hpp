// Validation and tolerances of triangles, and the proximity of one.
#pragma once

#include <algorithm>

#include "base/validation.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace supernormal {

/// Adjacent vertices may differ, most of all where a program computes them twice. So do a vertex and the edge on which it was
/// placed. The tolerance is this fraction of a triangle's longest side.
inline constexpr double kSeam = 1e-6;

/// Whether the coordinates are finite and within kMaxLength.
inline bool is_usable(const MeshTriangle& triangle) {
  return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                     [](const Vector3& vertex) { return (vertex.array().abs() <= kMaxLength).all(); });
}

inline double longest_side(const MeshTriangle& triangle) {
  const std::array<Vector3, 3>& v = triangle.vertices;
  return std::max({(v[1] - v[0]).norm(), (v[2] - v[1]).norm(), (v[0] - v[2]).norm()});
}

/// Calls find_proximity() with the two-sided triangle as body 2. `vertices`: m, in the frame of the pose.
Proximity find_triangle_proximity(const Shape& shape, const Pose& pose, const std::array<Vector3, 3>& vertices,
                                  const Settings& settings, const Vector3* first_normal = nullptr);

}  // namespace supernormal
