// The polygon that a body would stand on if it stood on one of its tangent planes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The support polygon of a body on its tangent plane with normal n, explicit in the normal parameterization:
///
/// 1. The plane tilts along each of the two axes of the body in the plane, in both directions. The body touches the tilted plane in
///    q = r(n + w). This takes one evaluation for each tilt. q is the end of a flat face or of a straight edge. Where the body is
///    round, q is next to p = r(n).
/// 2. The separations D of q from the plane and R of p from the tilted plane are the two Bregman divergences of the support
///    function between n and n + w. The fraction D / (D + R) says how flat the body is along the axis, at every scale. It is 1/e
///    for a face like |x|^e, and 1/2 for an ellipsoid of any half-axes. It gives the width of the polygon.
/// 3. A face that is tilted against the plane has separations, too. So if the fraction is not small, it is computed again for the
///    tangent plane parallel to the face.
/// 4. Where the body is flat along both axes, the vertices are the points of the four diagonal tilts. Where it is flat along one
///    axis and round along the other, they are the ends of the flat axis. Where it is round along both, they are p.
///
/// lib/contact/theory.md has the proofs.
class SupportPolygon {
 public:
  /// `n`: unit, in the frame that the pose refers to. `support_point`: the body's point with this normal, m. `depth`: the depth of
  /// the overlap, or the one that would form in the step without contact forces, m. `thickness`: the smallest half-extent of the
  /// other body, m. It limits the polygon, because a pebble does not stand on what is flat at the scale of a boulder.
  /// `without_ball`: a ball that rolls in the body takes a rim from its faces and edges. Otherwise the vertices are points of the
  /// body.
  SupportPolygon(const Shape& shape, const Pose& pose, const Vector3& n, const Vector3& support_point, double depth,
                 bool without_ball, double thickness = HUGE_VAL);

  /// Whether the polygon is more than the support point.
  bool has_width() const { return widths_[0] > 0 || widths_[1] > 0; }

  /// The vertices relative to the support point, in the tangent plane, counter-clockwise about n, m. The body has points at most
  /// largest_separation() below them.
  const std::array<Vector3, 4>& vertices() const { return vertices_; }

  const Vector3& support_point() const { return support_point_; }

  /// The separation of the body from each vertex, m: the point of the boundary under it. NaN where a vertex is no support point.
  const std::array<double, 4>& separations() const { return separations_; }

  /// The tilt of the face against the plane: the gradient of its separation, a vector in the plane.
  const Vector3& slope() const { return slope_; }

  /// The axis of the body's frame that lies between the diagonals, projected into the tangent plane; unit. It points across a
  /// polygon that is much longer than wide.
  const Vector3& axis() const { return axes_[0]; }
  bool is_long() const { return is_long_; }

  /// The product of the half-extents of the body along the plane, m^2, and the smaller one, m.
  double area() const { return extents_[0] * extents_[1]; }
  double size() const { return std::min(extents_[0], extents_[1]); }

  /// m; how far apart the bodies may be where they rest on each other.
  double reach() const { return reach_; }

  /// m; the smallest of the half-height and the half-extents along the plane.
  double least_extent() const { return least_extent_; }

  /// The largest separation of a vertex from the plane, m.
  double largest_separation() const { return largest_separation_; }

  int evaluations() const { return evaluations_; }

 private:
  class Tilts;
  struct View;

  SupportPolygon(const View& view, double depth, double thickness);

  void find(const View& view, const std::array<double, 2>& tangents);
  std::array<double, 2> widths_by(const Tilts& tilts);
  void place_vertices(const Tilts& tilts);
  void put_axis_across();

  Vector3 support_point_;
  std::array<Vector3, 2> axes_;
  std::array<double, 2> extents_{};
  double height_ = 0;
  double least_extent_ = 0;
  double reach_ = 0;
  std::array<double, 2> widths_{};
  Vector3 slope_ = Vector3::Zero();
  bool is_long_ = false;
  std::array<Vector3, 4> vertices_;
  std::array<double, 4> separations_{};
  double largest_separation_ = 0;
  int evaluations_ = 0;
};

}  // namespace supernormal
