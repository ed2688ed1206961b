// The normal of a flat body whose sections are sharp.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "supernormal/shapes/power_norm.hpp"

namespace supernormal {

/// Whether the angle between them is larger than 45 degrees.
inline bool are_far_apart(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::abs(a.x() * b.y() - a.y() * b.x()) > a.dot(b);
}

/// A step of advance_normal() as it is seen along the axis of such a body: how the part of the normal across the axis turns while
/// the boundary point moves, and the normal grows, on a flat face. Scaled by the half-axes of the section.
struct SectionTurn {
  Eigen::Vector2d normal, turn;   ///< n and dn, divided by h
  Eigen::Vector2d point, target;  ///< where the boundary point is, and H dn beside it
  double length;                  ///< of the normal there, in the section's dual norm

  /// The direction of the normal there, in the dual norm a unit vector; zero for a normal along the axis.
  ///
  /// Along a sharp section the boundary point is a high power of the normal's direction, so the normal goes its own way: by an
  /// angle, since what holds it is a curvature in proportion to its length. But a turn that the section does not hold, as on one of
  /// its edges, which the point does not leave, comes from the other body: it is no longer where the normal is longer, and what is
  /// longer yet leads past the corner, where it is held. Across the middle of the face lies the opposite edge, with the opposite
  /// normal.
  Eigen::Vector2d direction(const PowerNorm& dual) const {
    const auto size = [&dual](const Eigen::Vector2d& v) { return dual.value(std::abs(v.x()), std::abs(v.y())); };
    Eigen::Vector2d moved = normal + turn;
    const double side = point.dot(target) < 0 ? -1 : 1;
    const double before = size(normal);
    const bool is_held = !are_far_apart(side * normal, moved) || are_far_apart(side * point, target);
    if (!is_held && before > 0 && before < length)
      moved = normal / before * (side * length) + turn * std::min(1.0, length / size(turn));
    const double after = size(moved);
    return after > 0 ? Eigen::Vector2d(moved / after) : Eigen::Vector2d(Eigen::Vector2d::Zero());
  }
};

}  // namespace supernormal
