// The normal of a body along a section with sharp vertices.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace supernormal {

/// Whether a normal turns about an axis by more than 45 degrees. Of it, these are the parts across the axis, scaled by the
/// half-axes of the section.
///
/// Along a sharp section the boundary point is a high power of the normal's direction, so the normal goes its own way there, and
/// the point tells it less well. But near the axis, as on a flat face, where that part of the normal may be as small as can be, a
/// step that the section's curvature does not hold turns it far. Then the point tells it better.
inline bool turns_far(const Eigen::Vector2d& normal, const Eigen::Vector2d& moved) {
  return std::abs(normal.x() * moved.y() - normal.y() * moved.x()) > normal.dot(moved);
}

}  // namespace supernormal
