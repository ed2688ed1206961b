// A test that decides how a body's normal moves along a section with sharp vertices.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace supernormal {

/// Whether a normal turns about an axis by more than 45 degrees. The arguments are the parts of the normal across the axis,
/// scaled by the half-axes of the section.
///
/// Along a sharp section the boundary point is a high power of the normal's direction, so the normal moves independently there,
/// and the point determines it less well. But near the axis, as on a flat face, where that part of the normal may be arbitrarily
/// small, a step that exceeds the section's radius of curvature turns it far. Then the point determines it better.
inline bool turns_far(const Eigen::Vector2d& normal, const Eigen::Vector2d& moved) {
  return std::abs(normal.x() * moved.y() - normal.y() * moved.x()) > normal.dot(moved);
}

}  // namespace supernormal
