// How a common normal responds to motions of the two bodies, in its tangent plane.
#pragma once

#include <array>

#include "proximity/local/local_model.hpp"

namespace supernormal {

// rad: derivatives that hold over a smaller rotation only count as not defined. Over 1e-6 the difference of two gaps still has nine
// digits, and poses from a solver or a measurement that are nearer to a kink are usually meant to be on it.
inline constexpr double kNearby = 1e-6;

// In units of the last place of the bodies' sizes: vertices whose heights along a normal differ by less are tied.
inline constexpr double kTieUnits = 32;

using Matrix2 = Eigen::Matrix2d;

/// The radii of curvature of one body in a tangent plane. Along at most two directions the radius is infinite: along an edge, a
/// face, or where a smooth body is flat to rounding.
struct BodyCurvature {
  Symmetric2 A;                   ///< m; the finite radii
  std::array<Vector2, 2> flat{};  ///< unit; the directions of infinite radius. Two of them span the plane
  int flat_count = 0;
  double rounding = 0;  ///< m; of the finite radii, beside an infinite one

  /// Makes the radius infinite along `direction`, of any length but 0. Directions closer than about 1e-7 rad are the same.
  void flatten(const Vector2& direction);

  /// Whether the radius is infinite along `direction`, a unit vector.
  bool is_flat_along(const Vector2& direction) const;

  /// m; A without what it has along the directions of infinite radius.
  Symmetric2 across_flat() const;

  /// Whether the boundary point moves as far as on a flat side when the body rotates by kNearby. `size` (m) is that of the smaller
  /// body.
  bool may_be_flat(double size) const;
};

/// With M = A1 + A2 + s I: G = M^-1, B1 = G A1, B2 = G A2 and W = A1 G A2, in the limit of infinite radii. Every derivative
/// consists of these. None contains a difference of large numbers: A1 - A1 G A1, for example, is W + s B1^T.
struct TangentResponse {
  enum class Kind { Regular, Singular, Free };

  Kind kind = Kind::Singular;
  Matrix2 G = Matrix2::Zero();   ///< 1/m; the tilt of the normal by the displacement of point 2 across it
  Matrix2 B1 = Matrix2::Zero();  ///< the tilt by a rotation of body 1
  Matrix2 B2 = Matrix2::Zero();  ///< the tilt by a rotation of body 2
  Matrix2 W = Matrix2::Zero();   ///< m

  /// `s` and `length_unit` in m. Singular if M is not positive definite beyond rounding in the directions of finite radius, Free if
  /// the flat parts of both bodies share a direction.
  static TangentResponse of(const BodyCurvature& body1, const BodyCurvature& body2, double s, double length_unit);

  /// Whether this response, in `plane`, and `other` in a plane nearby are Regular and differ by at most this part. `largest`: m,
  /// the size of the larger body. A radius of curvature that is much longer belongs to a flat side, whose normal hardly moves.
  bool is_near(const TangentPlane& plane, const TangentResponse& other, const TangentPlane& others, double part,
               double largest) const;
};

}  // namespace supernormal
