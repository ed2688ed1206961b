// The proximity of a body and one triangle.
#pragma once

#include <array>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Calls find_proximity() with the two-sided triangle as body 2. `vertices`: m, in the frame of the pose.
Proximity find_triangle_proximity(const Shape& shape, const Pose& pose, const std::array<Vector3, 3>& vertices,
                                  const Settings& settings, const Vector3* first_normal = nullptr);

}  // namespace supernormal
