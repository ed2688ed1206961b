// Upper bounds of the gap function from the boundary points that were evaluated.
#pragma once

#include <array>
#include <span>

#include "proximity/tangent_plane.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The differences d_k = point2 - point1 of all evaluations of one query (of the last kCapacity).
///
/// A support function is the largest projection of its body: h(m) >= m.r(n) for every n. Hence s(m) <= m.d_k for every unit m,
/// whatever the curvature: each evaluation cuts off the normals that cannot be the answer. GJK and EPA are built on the same cuts.
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

  void clear() { count_ = 0; }
  void add(const Vector3& d) { d_[static_cast<std::size_t>(count_++ % kCapacity)] = d; }
  std::span<const Vector3> points() const { return {d_.data(), static_cast<std::size_t>(size())}; }
  int size() const { return count_ < kCapacity ? count_ : kCapacity; }

  /// The least of m.d_k, which s(m) cannot exceed; m need not be of unit length (both sides are homogeneous of degree 1).
  double upper_bound(const Vector3& m) const;

  /// Maximum of the least of the cuts over the gnomonic disc |u| <= radius, by steepest ascent on the piecewise linear
  /// model from u = 0: finite, because it moves from ridge to ridge. At least one cut is needed.
  Maximum maximize(const TangentPlane& plane, double radius) const;

  /// How far from u the cuts allow unit normals with s > level, for a level < 0: the way on which it is farthest (unit), of eight
  /// and of those between the cuts, and the distance; infinite where no cut stops it. A cut that allows them again before the
  /// distance `least` does not: as one at the level, but for the rounding of its slope.
  struct Reach {
    Vector2 way = Vector2::UnitX();
    double distance = 0;
  };
  Reach reach(const TangentPlane& plane, const Vector2& u, double level, double least) const;

 private:
  std::array<Vector3, kCapacity> d_;
  int count_ = 0;
};

}  // namespace supernormal
