// The part of a body near its highest point: what overlaps with a plane or with another body.
#pragma once

#include <array>

#include "contact/footprint.hpp"
#include "supernormal/shapes/shape.hpp"
#include "supernormal/solvers/pose.hpp"

namespace supernormal {

/// The cap of a body in direction n: its points that are less than `depth` below its tangent plane with normal n.
///
/// Seen along n the cap is a convex region, found by how far it reaches in eight directions: along the body's axes as they lie in
/// the tangent plane and along the diagonals between them, which are the corners of a box. The point that reaches farthest in a
/// direction u has a normal between n and u; so it is on a curve of boundary points, cos(t) n + sin(t) u, explicit in the normal
/// parameterization, and one unknown t remains.
class Cap {
 public:
  /// `n` of unit length, in the frame that the pose refers to.
  Cap(const Shape& shape, const Pose& pose, const Vector3& n, double depth);

  /// The two axes of the body in the tangent plane, of unit length, perpendicular to n and to one another.
  const std::array<Vector3, 2>& axes() const { return axes_; }

  /// The width along a unit vector in the tangent plane that a cap must exceed to count as wide, m. A quarter of the body's, and
  /// this much more than the cap of the same depth of an ellipsoid with its half-extents.
  double wide_from(const Vector3& direction) const;

  /// About the area of the body's shadow in the tangent plane, m^2.
  double shadow() const { return extent(axes_[0]) * extent(axes_[1]); }

  /// Finds how far the cap reaches along the axes, and returns whether it is narrow along both.
  bool is_narrow();

  /// The region; is_narrow() comes first. Points of the cap are its corners, so that it lies within the cap.
  Footprint footprint(const PatchFrame& frame);

  int evaluations() const { return evaluations_; }

 private:
  Vector3 farthest(const Vector3& direction);
  double extent(const Vector3& direction) const;

  const Shape* shape_;
  Pose pose_;
  Vector3 n_;
  Jet highest_;  // of n
  double depth_;
  Vector3 half_extents_;
  std::array<Vector3, 2> axes_;
  std::array<Vector3, 4> along_axes_;  // farthest in the directions +axis 0, +axis 1, -axis 0, -axis 1
  int evaluations_ = 1;
};

}  // namespace supernormal
