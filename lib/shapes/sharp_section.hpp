// Decides how a body's normal moves along a section with sharp vertices.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace supernormal {

/// Whether a normal rotates about an axis by more than 45 degrees. The arguments are the normal's components across the axis,
/// scaled by the half-axes of the section.
///
/// Along a sharp section the boundary point is a high power of the normal's direction. There the normal moves by itself, because
/// the point determines it less accurately. Near the axis, as on a flat face, the components across the axis may be arbitrarily
/// small. There a step beyond the section's radius of curvature rotates them far, and the point determines the normal more
/// accurately.
inline bool rotates_far(const Eigen::Vector2d& normal, const Eigen::Vector2d& moved) {
  return std::abs(normal.x() * moved.y() - normal.y() * moved.x()) > normal.dot(moved);
}

}  // namespace supernormal
