// Vectors and symmetric matrices in the plane perpendicular to a normal.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace supernormal {

using Vector2 = Eigen::Vector2d;

/// An orthonormal basis t1, t2 of the plane perpendicular to a unit normal. A direction near n is given by gnomonic coordinates u:
/// it is the direction of n + u1 t1 + u2 t2, so that |u| is the tangent of the angle.
struct TangentPlane {
  Eigen::Vector3d n, t1, t2;

  /// t1 is the projection of `direction`, which must not be parallel to the normal.
  TangentPlane(const Eigen::Vector3d& normal, const Eigen::Vector3d& direction) : n(normal) {
    t1 = (direction - n.dot(direction) * n).normalized();
    t2 = n.cross(t1);
  }

  /// The same plane in another frame, x' = R x.
  TangentPlane rotated(const Eigen::Matrix3d& R) const { return TangentPlane(R * n, R * t1, R * t2); }

  Vector2 project(const Eigen::Vector3d& v) const { return {t1.dot(v), t2.dot(v)}; }
  Eigen::Vector3d lift(const Vector2& u) const { return u.x() * t1 + u.y() * t2; }

 private:
  TangentPlane(const Eigen::Vector3d& normal, const Eigen::Vector3d& first, const Eigen::Vector3d& second)
      : n(normal), t1(first), t2(second) {}
};

/// A symmetric matrix [xx xy; xy yy].
struct Symmetric2 {
  double xx = 0, xy = 0, yy = 0;

  static Symmetric2 project(const TangentPlane& plane, const Eigen::Matrix3d& H) {
    const Eigen::Vector3d H1 = H * plane.t1;
    return {plane.t1.dot(H1), plane.t2.dot(H1), plane.t2.dot(H * plane.t2)};
  }

  /// As a matrix of vectors in space, of which it takes those of the plane.
  Eigen::Matrix3d lift(const TangentPlane& plane) const {
    return plane.t1 * (xx * plane.t1 + xy * plane.t2).transpose() + plane.t2 * (xy * plane.t1 + yy * plane.t2).transpose();
  }

  Vector2 operator*(const Vector2& u) const { return {xx * u.x() + xy * u.y(), xy * u.x() + yy * u.y()}; }
  double trace() const { return xx + yy; }
  bool operator==(const Symmetric2&) const = default;
  Symmetric2 operator+(const Symmetric2& o) const { return {xx + o.xx, xy + o.xy, yy + o.yy}; }
  Symmetric2 plus_identity(double shift) const { return {xx + shift, xy, yy + shift}; }

  /// The vector that this matrix maps to b; infinite when the matrix is singular or as good as that: when the vector would be
  /// beyond kLongest. Scaled first, since radii of curvature go up to 1e120.
  Vector2 solve(const Vector2& b) const {
    const Vector2 singular = Vector2::Constant(std::numeric_limits<double>::infinity());
    const double size = std::abs(xx) + std::abs(yy);
    const double length = std::abs(b.x()) + std::abs(b.y());
    // Asked before dividing: overflow would raise a floating-point exception.
    if (!(size > kSmallest && length < kLongest * size)) return singular;
    const double scale = 1 / size;
    const double sxx = xx * scale, sxy = xy * scale, syy = yy * scale;
    const Vector2 sb = b * scale;
    const double determinant = sxx * syy - sxy * sxy;
    const Vector2 adjugate(syy * sb.x() - sxy * sb.y(), sxx * sb.y() - sxy * sb.x());
    if (!(std::abs(adjugate.x()) + std::abs(adjugate.y()) < kLongest * std::abs(determinant))) return singular;
    return adjugate / determinant;
  }

 private:
  static constexpr double kLongest = 1e150;
  static constexpr double kSmallest = 1e-300;  // its inverse is finite
};

/// Eigenvalues and vectors of a symmetric 2 x 2 matrix, low <= high.
struct Eigen2 {
  double low, high;
  Vector2 low_vector, high_vector;

  explicit Eigen2(const Symmetric2& A) {
    const double mean = 0.5 * A.trace();
    const double half_difference = 0.5 * (A.xx - A.yy);
    // Scaled, so that no square over- or underflows: two vertices leave next to nothing beside the mean.
    const double scale = std::max(std::abs(half_difference), std::abs(A.xy));
    const double cosine = scale > 0 ? half_difference / scale : 0;
    const double sine = scale > 0 ? A.xy / scale : 0;
    const double length = std::sqrt(cosine * cosine + sine * sine);
    const double radius = scale * length;
    // The eigenvalue of larger size by the sum; the other by the determinant, since the difference would cancel: where one radius
    // of curvature is huge it would leave nothing of the small one.
    const double large = mean >= 0 ? mean + radius : mean - radius;
    const double small = large != 0 ? A.xx * (A.yy / large) - A.xy * (A.xy / large) : 0;
    low = mean >= 0 ? small : large;
    high = mean >= 0 ? large : small;
    // Of the two ways to write the eigenvector take the one without cancellation.
    const Vector2 v = half_difference >= 0 ? Vector2(length + cosine, sine) : Vector2(sine, length - cosine);
    high_vector = scale > 0 ? Vector2(v.normalized()) : Vector2(1, 0);
    low_vector = Vector2(-high_vector.y(), high_vector.x());
  }
};

}  // namespace supernormal
