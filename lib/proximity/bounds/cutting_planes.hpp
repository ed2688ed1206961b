// Upper bounds of the gap function from the boundary points that were evaluated.
#pragma once

#include <array>
#include <span>

#include "proximity/tangent_plane.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The differences d_k = point2 - point1 + rho n of the evaluations of one query (of kCapacity), rho being the radius of a ball
/// that rolls inside the difference of the bodies, which is taken out of it.
///
/// A support function is the largest projection of its body: h(m) >= m.r(n) for every n. Hence s(m) + rho <= m.d_k for every unit
/// m, whatever the radii of curvature: each evaluation cuts off the normals that cannot be the answer. GJK and EPA are built on the
/// same cuts. The centre of the difference of two symmetric bodies gives one more, which no evaluation costs.
class CuttingPlanes {
 public:
  static constexpr int kCapacity = 32;

  /// What maximize() finds.
  struct Maximum {
    Vector2 u = Vector2::Zero();  ///< where, in gnomonic coordinates
    double value = 0;             ///< the model there, m
    double uncertainty = 0;       ///< m; an interior maximum may be higher by this
    bool is_interior = false;     ///< the maximum of the model over the whole plane, not just within the radius
  };

  /// Where there is no room, the new cut takes the place of the highest at the normal that was last told to keep_lowest_at(), or of
  /// the oldest.
  void add(const Vector3& d);

  /// The cuts that are lowest at the normal n hold a bound or a step: they stay.
  void keep_lowest_at(const Vector3& n) { kept_at_ = n; }

  /// The difference of the centres of two point-symmetric bodies: any ball that rolls inside such a body fits in at its centre, so
  /// that no support function is less than its radius.
  void set_centre(const Vector3& c) {
    d_[0] = c;
    has_centre_ = true;
  }

  /// All points that cut.
  std::span<const Vector3> points() const {
    const std::size_t centres = has_centre_ ? 1 : 0;
    return {d_.data() + 1 - centres, boundary_points().size() + centres};
  }
  /// Those of evaluations.
  std::span<const Vector3> boundary_points() const {
    return {d_.data() + 1, static_cast<std::size_t>(count_ < kCapacity ? count_ : kCapacity)};
  }

  /// The least of m.d_k, which s(m) cannot exceed; m need not be of unit length (both sides are homogeneous of degree 1).
  double upper_bound(const Vector3& m) const;

  /// Maximum of the least of the cuts over the gnomonic disc |u| <= radius, by steepest ascent on the piecewise linear
  /// model from u = 0: finite, because it moves from ridge to ridge. At least one cut is needed.
  Maximum maximize(const TangentPlane& plane, double radius) const;

 private:
  std::array<Vector3, 1 + kCapacity> d_;  // the first is the centre's
  bool has_centre_ = false;
  int count_ = 0, oldest_ = 0;
  Vector3 kept_at_ = Vector3::Zero();
};

}  // namespace supernormal
