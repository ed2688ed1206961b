// A body's box along the axes of its own frame.
#pragma once

#include <array>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The box of a body, in m, in the body's frame. It has a centre, because a body may extend farther to one side of its origin than
/// to the other; Shape::half_extents() contains the half-lengths only.
struct SUPERNORMAL_API BodyBox {
  Vector3 centre;        ///< the middle of the box
  Vector3 half_lengths;  ///< from the middle to the sides

  /// The smallest box that contains the body, exact except for rounding.
  static BodyBox of(const Shape& shape);

  /// The box widened by `margin` (m) on all sides.
  BodyBox widened(double margin) const { return {centre, half_lengths.array() + margin}; }

  /// Whether the box, widened by `margin` (m) on all sides, contains the point.
  bool contains(const Vector3& point, double margin) const;

  /// Whether the triangle and the box have a common point. `vertices` are in the frame that `pose`, the body's pose, refers to.
  /// Also true if a coordinate is NaN.
  bool touches(const Pose& pose, const std::array<Vector3, 3>& vertices) const;
};

}  // namespace supernormal
