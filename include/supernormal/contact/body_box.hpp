// The box around a body along the axes of its own frame.
#pragma once

#include <array>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// All in m, in the body's frame. Shape::half_extents() has no centre: a body need not reach equally far to both sides.
struct SUPERNORMAL_API BodyBox {
  Vector3 centre;        ///< the middle of the box
  Vector3 half_lengths;  ///< from the middle to its sides

  /// The smallest such box, exact but for rounding.
  static BodyBox of(const Shape& shape);

  /// The box widened by `margin` on all sides.
  BodyBox widened(double margin) const { return {centre, half_lengths.array() + margin}; }

  /// Whether the point is in the box widened by `margin` on all sides.
  bool contains(const Vector3& point, double margin) const;

  /// Whether the triangle, with vertices in the frame that the pose of the body refers to, has a point in common with the box; true
  /// as well if a coordinate is not a number.
  bool touches(const Pose& pose, const std::array<Vector3, 3>& vertices) const;
};

}  // namespace supernormal
