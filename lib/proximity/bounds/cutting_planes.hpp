// Upper bounds on the gap function from evaluated boundary points: supporting half-spaces.
#pragma once

#include <array>
#include <span>

#include "base/tangent_plane.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The points d_k = point2 - point1 + rho n of up to kCapacity evaluations of one query. rho is the radius of a ball that rolls
/// inside the Minkowski difference and is taken out of it.
///
/// A support function is the largest projection of its body: h(m) >= m.r(n) for every n. Hence s(m) + rho <= m.d_k for every unit
/// m, whatever the radii of curvature. Each evaluation gives such a half-space, or cut, which excludes normals that cannot be the
/// answer. GJK and EPA are built on the same cuts. The centre of the Minkowski difference of two symmetric bodies gives one more
/// cut, without an evaluation.
class CuttingPlanes {
 public:
  static constexpr int kCapacity = 32;

  /// The result of maximize().
  struct Maximum {
    Vector2 u = Vector2::Zero();  ///< gnomonic coordinates of the maximum
    double value = 0;             ///< m; the model's value there
    double uncertainty = 0;       ///< m; an interior maximum may be higher by this
    bool is_interior = false;     ///< whether it is the model's maximum over the whole plane
  };

  /// Adds a cut. If there is no room, it replaces the highest cut at the normal of the last keep_lowest_at(), or the oldest cut.
  void add(const Vector3& d);

  /// From now on add() keeps the lowest cuts at the normal n, because a bound or a step depends on them.
  void keep_lowest_at(const Vector3& n) { kept_at_ = n; }

  /// Adds the centre of the Minkowski difference of two point-symmetric bodies. Any ball that rolls inside such a body also fits at
  /// its centre. So no support function is less than its ball's radius.
  void set_centre(const Vector3& c) {
    d_[0] = c;
    has_centre_ = true;
  }

  /// The points of all cuts.
  std::span<const Vector3> points() const {
    const std::size_t centres = has_centre_ ? 1 : 0;
    return {d_.data() + 1 - centres, boundary_points().size() + centres};
  }
  /// The points of the cuts from evaluations.
  std::span<const Vector3> boundary_points() const {
    return {d_.data() + 1, static_cast<std::size_t>(count_ < kCapacity ? count_ : kCapacity)};
  }

  /// m; the least m.d_k, an upper bound on s(m) + rho. m may have any length, because both sides are homogeneous of degree 1.
  double upper_bound(const Vector3& m) const;

  /// The maximum of the minimum of the cuts over the gnomonic disc |u| <= radius. It is found by steepest ascent on the piecewise
  /// linear model from u = 0, which is finite because it moves from ridge to ridge. Needs at least one cut.
  Maximum maximize(const TangentPlane& plane, double radius) const;

 private:
  std::array<Vector3, 1 + kCapacity> d_;  // the first is the centre's
  bool has_centre_ = false;
  int count_ = 0, oldest_ = 0;
  Vector3 kept_at_ = Vector3::Zero();
};

}  // namespace supernormal
