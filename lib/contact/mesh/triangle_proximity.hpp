// The proximity of a body and one triangle.
#pragma once

#include <array>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Calls find_proximity() with the triangle, two-sided, as the second body. `vertices` are in m, in the frame that the pose
/// refers to.
Proximity find_triangle_proximity(const Shape& shape, const Pose& pose, const std::array<Vector3, 3>& vertices,
                                  const Settings& settings, const Vector3* first_normal = nullptr);

}  // namespace supernormal
