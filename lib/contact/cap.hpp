// The part of a body near its highest point: what overlaps with a plane or with another body.
#pragma once

#include <array>

#include "contact/footprint.hpp"
#include "supernormal/shapes/shape.hpp"
#include "supernormal/solvers/pose.hpp"

namespace supernormal {

/// The cap of a body in direction n: its points that are less than `depth` below its tangent plane with normal n.
///
/// Seen along n the cap is a convex region, found by how far it reaches along the diagonals between the body's axes as they lie in
/// the tangent plane, which are the corners of a box, and, unless it is much like one, along the axes too. The point that reaches
/// farthest in a direction u has a normal between n and u; so it is on a curve of boundary points, cos(t) n + sin(t) u, explicit in
/// the normal parameterization, and one unknown t remains.
class Cap {
 public:
  /// `n` of unit length, in the frame that the pose refers to.
  Cap(const Shape& shape, const Pose& pose, const Vector3& n, double depth);

  /// The two axes of the body in the tangent plane, of unit length, perpendicular to n and to one another.
  const std::array<Vector3, 2>& axes() const { return axes_; }

  /// The width along a unit vector in the tangent plane, m: `share` of the body's more than the cap of the same depth of an
  /// ellipsoid with its half-extents has. What is not wider is round.
  double wide_from(const Vector3& direction, double share) const;

  /// n.
  const Vector3& normal() const { return n_; }

  /// About the area of the body's shadow in the tangent plane, m^2.
  double shadow() const { return extent(axes_[0]) * extent(axes_[1]); }

  /// Whether one tangent plane on each side proves that is_narrow(), for four evaluations.
  bool is_surely_narrow();

  /// Finds how far the cap reaches along the diagonals, and returns whether these points are as narrow along both axes as
  /// those of a round body are.
  bool is_narrow();

  /// The region; is_narrow() comes first. Points of the cap are its corners, so that it lies within the cap.
  Footprint footprint(const PatchFrame& frame);

  int evaluations() const { return evaluations_; }

 private:
  Vector3 farthest(const Vector3& direction);
  double bound_along(const Vector3& direction);
  double extent(const Vector3& direction) const;
  double width(const Vector3& direction) const;

  const Shape* shape_;
  Pose pose_;
  Vector3 n_;
  Jet highest_;  // of n
  double depth_;
  Vector3 half_extents_;
  std::array<Vector3, 2> axes_;
  std::array<Vector3, 4> corners_;  // farthest in the directions +a +b, -a +b, -a -b, +a -b of the axes a, b
  double steepness_;                // of the last profile where the cap ended: slope times extent over depth
  int evaluations_ = 1;
};

}  // namespace supernormal
