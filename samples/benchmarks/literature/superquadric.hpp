// A superellipsoid in the forms of the literature: an implicit function, or two angles on its surface.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "supernormal/shapes/shape.hpp"

namespace literature {

using supernormal::Matrix3;
using supernormal::Vector3;
using Vector2 = Eigen::Vector2d;
using Matrix32 = Eigen::Matrix<double, 3, 2>;

/// The implicit function F and its derivatives at a point.
struct Implicit {
  double value;      ///< negative inside
  Vector3 gradient;  ///< 1/m
  Matrix3 hessian;   ///< 1/m^2
};

/// A point of the surface with its normal, and their derivatives by the two angles.
struct SurfacePoint {
  Vector3 point;         ///< m
  Vector3 normal;        ///< 1/m; outward, not of unit length
  Matrix32 point_rate;   ///< m/rad
  Matrix32 normal_rate;  ///< 1/(m rad)
};

/// F(x) = (|x/a|^delta + |y/b|^delta)^(epsilon/delta) + |z/c|^epsilon - 1, in the body's frame.
struct Superquadric {
  Vector3 half_axes;  ///< m
  double delta, epsilon;

  /// Empty unless the shape is a superellipsoid or an ellipsoid.
  static std::optional<Superquadric> of(const supernormal::Shape& shape);

  double value(const Vector3& x) const;  ///< F alone
  Implicit implicit(const Vector3& x) const;

  /// The surface at a latitude and a longitude, rad: (a C cos^(2/delta), b C sin^(2/delta), c sin^(2/epsilon)) with C =
  /// cos^(2/epsilon). Powers keep the sign of their base.
  SurfacePoint surface(const Vector2& angles) const;
  Vector3 point(const Vector2& angles) const;  ///< the point alone

  /// The angles at which the surface has this outward normal, of any length.
  Vector2 angles_of(const Vector3& normal) const;
};

}  // namespace literature
