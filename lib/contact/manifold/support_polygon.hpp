// The polygon that a body would stand on if it stood on one of its tangent planes.
#pragma once

#include <array>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The support polygon of a body on its tangent plane with normal n, explicit in the normal parameterization.
///
///  1. The plane tilts by a small angle towards each of four diagonals w. Then the body would stand on the point q = r(n + w), one
///     evaluation each: at the end of a flat face, and next to p = r(n) where the body is round.
///  2. The drop of q below the plane and the rise of p above the tilted plane are the two Bregman divergences of the support
///     function between n and n + w. The share of the drop in their sum says how flat the body is there, in every scale: 1/e of a
///     face like |x|^e, 1/2 where the body is as round as an ellipsoid, whatever its half-axes.
///  3. A plane that is tilted against a flat face has a drop, too. So where the share is not small, the face is judged once more by
///     the tangent plane that is parallel to the plane through the four points, for one more evaluation.
///  4. Along an axis along which the body is round, or leans too far, it stands on the line through p, and the points are drawn in
///     to it along chords of the body; then all points are drawn in to p, as the body becomes round, or where their drop is too
///     large.
///
/// lib/contact/README.md has the proofs and figures.
class SupportPolygon {
 public:
  struct Vertex {
    Vector3 offset = Vector3::Zero();  ///< m; from the support point, in the frame of the pose
    double drop = 0;                   ///< m; distance below the tangent plane
  };

  /// `n` is of unit length, in the frame that the pose refers to; `support_point` is that of the body with this normal, m;
  /// `depth` is that of the overlap, m.
  SupportPolygon(const Shape& shape, const Pose& pose, const Vector3& n, const Vector3& support_point, double depth);

  /// The largest drop of a vertex, m: between the bodies there is at most the excess of this over the depth.
  double reach() const { return reach_; }

  /// m; a vertex whose drop exceeds that of another by more than this is too far in the air to rest on.
  double largest_lean() const { return largest_lean_; }

  /// 0: the body is round at the support point, which is its only one; 1: it is flat.
  double flatness() const { return flatness_; }

  /// The vertices, counter-clockwise about n.
  const std::array<Vertex, 4>& vertices() const { return vertices_; }

  const Vector3& support_point() const { return support_point_; }

  /// The axis of the body's frame that lies between the diagonals, projected into the tangent plane; unit. It is across a straight
  /// edge.
  const Vector3& axis() const { return axes_[0]; }
  bool has_straight_edge() const { return has_straight_edge_; }

  /// The product of the half-extents of the body along the plane, m^2, and the smaller one, m.
  double area() const { return extents_[0] * extents_[1]; }
  double size() const { return std::min(extents_[0], extents_[1]); }

  int evaluations() const { return evaluations_; }

 private:
  /// A point q of the body, relative to the support point: along the axes and along -n, m.
  struct PatchSupport {
    std::array<double, 2> way;
    double drop;

    PatchSupport mixed_with(const PatchSupport& other, double own) const {
      return {{own * way[0] + (1 - own) * other.way[0], own * way[1] + (1 - own) * other.way[1]},
              own * drop + (1 - own) * other.drop};
    }
  };
  /// The share of the drop in the sum of drop and rise: along both axes, and along either one.
  struct Shares {
    double both;
    std::array<double, 2> along;

    Shares lesser_of(const Shares& other) const {
      return {std::min(both, other.both), {std::min(along[0], other.along[0]), std::min(along[1], other.along[1])}};
    }
  };
  using Tilt = std::array<double, 2>;  // tilt of the normal, n + tilt[0] axes[0] + tilt[1] axes[1]

  class Observer;
  class StraightEdge;
  class View;

  Tilt tilt_of_face(const std::array<PatchSupport, 4>& sights, const Tilt& diagonal) const;
  static std::array<PatchSupport, 4> drawn_in(std::array<PatchSupport, 4> points, const std::array<double, 2>& widths);
  void place_vertices(const std::array<PatchSupport, 4>& points, const Vector3& n);

  Vector3 support_point_;
  std::array<Vector3, 2> axes_;
  std::array<double, 2> extents_{};
  double reach_;
  double largest_lean_;
  double flatness_ = 0;
  bool has_straight_edge_ = false;
  std::array<Vertex, 4> vertices_;
  int evaluations_ = 0;
};

}  // namespace supernormal
