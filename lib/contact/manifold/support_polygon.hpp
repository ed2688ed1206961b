// The polygon that a body would stand on if it stood on one of its tangent planes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The support polygon of a body on its tangent plane with normal n, explicit in the normal parameterization.
///
///  1. The plane tilts along each of the two axes of the body in the plane, both ways. Then the body would stand on the point q =
///     r(n + w), one evaluation each: at the end of a flat face or of a straight edge, and next to p = r(n) where the body is
///     round.
///  2. The separations of q from the plane and of p from the tilted plane are the two Bregman divergences of the support function
///     between n and n + w. The fraction of the first in their sum says how flat the body is along the axis, at every scale: 1/e of
///     a face like |x|^e, 1/2 where the body is as round as an ellipsoid, whatever its half-axes. It is the width of the polygon.
///  3. A face that is tilted against the plane has separations, too. So where the fraction is not small, the face is judged once
///     more by the tangent plane that is parallel to it.
///  4. The vertices are the points of the four diagonal tilts where the body is flat along both axes, those of the axis along which
///     it is flat where it is round along the other, and p where it is round along both.
///
/// lib/contact/README.md has the proofs and figures.
class SupportPolygon {
 public:
  /// `n` is of unit length, in the frame that the pose refers to; `support_point` is the body's point with this normal, m; `depth`
  /// is the depth of the overlap, m; `thickness` is the smallest half-extent of the other body, m: a pebble does not stand on what
  /// is flat to a share of a boulder's size.
  SupportPolygon(const Shape& shape, const Pose& pose, const Vector3& n, const Vector3& support_point, double depth,
                 double thickness = HUGE_VAL);

  /// The same with one tilt along both axes, whatever the depth: for contacts whose gaps are known. Its vertices are those of the
  /// tilts, however far they are from the plane, and largest_lean() says nothing.
  static SupportPolygon of_tilt(const Shape& shape, const Pose& pose, const Vector3& n, const Vector3& support_point, double tilt);

  /// Whether there is more than the support point.
  bool has_width() const { return widths_[0] > 0 || widths_[1] > 0; }

  /// The vertices relative to the support point, in the tangent plane, m, counter-clockwise about n. The body has points at most
  /// largest_separation() below them.
  const std::array<Vector3, 4>& vertices() const { return vertices_; }

  const Vector3& support_point() const { return support_point_; }

  /// The tilt of the face against the plane: how fast it leaves the plane along it, a vector in the plane.
  const Vector3& slope() const { return slope_; }

  /// The axis of the body's frame that lies between the diagonals, projected into the tangent plane; unit. It is across a polygon
  /// that is much longer than wide.
  const Vector3& axis() const { return axes_[0]; }
  bool is_long() const { return is_long_; }

  /// The product of the half-extents of the body along the plane, m^2, and the smaller one, m.
  double area() const { return extents_[0] * extents_[1]; }
  double size() const { return std::min(extents_[0], extents_[1]); }

  /// m; a corner that leans by more than this beyond the depth is in the air.
  double largest_lean() const;

  /// The largest separation of a vertex from the plane, m.
  double largest_separation() const { return largest_separation_; }

  int evaluations() const { return evaluations_; }

 private:
  class Tilts;
  struct View;

  explicit SupportPolygon(const View& view);
  SupportPolygon(const View& view, double depth, double thickness);

  void find(const View& view, const std::array<double, 2>& tangents);
  std::array<double, 2> widths_seen_by(const Tilts& tilts);
  void place_vertices(const Tilts& tilts);
  void turn_across();

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
  double largest_separation_ = 0;
  int evaluations_ = 0;
};

}  // namespace supernormal
