// Vectors and symmetric matrices in the plane perpendicular to a normal.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/finite.hpp"

namespace supernormal {

using Vector2 = Eigen::Vector2d;

inline double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// An orthonormal basis t1, t2 of the plane perpendicular to a unit normal n. A direction near n has gnomonic coordinates u: it is
/// the direction of n + u1 t1 + u2 t2. So |u| is the tangent of the angle.
struct TangentPlane {
  Eigen::Vector3d n, t1, t2;

  /// The plane across the first axis.
  TangentPlane() : n(Eigen::Vector3d::UnitX()), t1(Eigen::Vector3d::UnitY()), t2(Eigen::Vector3d::UnitZ()) {}

  /// t1 is the projection of `direction`, which must not be parallel to the normal.
  TangentPlane(const Eigen::Vector3d& normal, const Eigen::Vector3d& direction) : n(normal) {
    t1 = (direction - n.dot(direction) * n).normalized();
    t2 = n.cross(t1);
  }

  /// The plane with t1 along the projection of the coordinate axis that is most nearly perpendicular to the normal.
  static TangentPlane at(const Eigen::Vector3d& normal) {
    int axis = 0;
    normal.cwiseAbs().minCoeff(&axis);
    return {normal, Eigen::Vector3d::Unit(axis)};
  }

  /// The plane with t1 along the axis of the frame of H along which the boundary is flattest. So the large radius of curvature of a
  /// face does not swamp the radius across it. A point has no curvature and no such axis.
  static TangentPlane along_flattest(const Eigen::Vector3d& normal, const Eigen::Matrix3d& H) {
    int axis = 0;
    return H.diagonal().maxCoeff(&axis) > 0 ? TangentPlane(normal, Eigen::Vector3d::Unit(axis)) : at(normal);
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

  Vector2 operator*(const Vector2& u) const { return {xx * u.x() + xy * u.y(), xy * u.x() + yy * u.y()}; }
  double trace() const { return xx + yy; }
  bool operator==(const Symmetric2&) const = default;
  Symmetric2 operator+(const Symmetric2& o) const { return {xx + o.xx, xy + o.xy, yy + o.yy}; }
  Symmetric2 plus_identity(double shift) const { return {xx + shift, xy, yy + shift}; }

  /// The vector that this matrix maps to b. Infinite if the matrix is singular, or so nearly singular that the vector would be
  /// beyond kLongest. Eliminates with the largest pivot: radii of curvature up to 1e120 occur beside radii of 1e-270, and products
  /// of these would underflow.
  Vector2 solve(const Vector2& b) const {
    const double x_size = std::abs(xx), y_size = std::abs(yy);
    double x = 0, y = 0;
    bool is_regular = false;
    if (std::abs(xy) > std::max(x_size, y_size)) {
      const double rate = yy / xy;
      is_regular = divide(b.y() - rate * b.x(), xy - rate * xx, x) && divide(b.x() - xx * x, xy, y);
    } else if (x_size >= y_size) {
      const double rate = x_size > 0 ? xy / xx : 0;
      is_regular = divide(b.y() - rate * b.x(), yy - rate * xy, y) && divide(b.x() - xy * y, xx, x);
    } else {
      const double rate = xy / yy;
      is_regular = divide(b.x() - rate * b.y(), xx - rate * xy, x) && divide(b.y() - xy * x, yy, y);
    }
    return is_regular ? Vector2(x, y) : Vector2(Vector2::Constant(std::numeric_limits<double>::infinity()));
  }

 private:
  static constexpr double kLongest = 1e150;

  /// Returns false if the quotient would be beyond kLongest.
  static bool divide(double numerator, double denominator, double& quotient) {
    if (!is_quotient_within(numerator, denominator, kLongest)) return false;
    quotient = numerator / denominator;
    return true;
  }
};

/// Eigenvalues and eigenvectors of a symmetric 2 x 2 matrix, low <= high.
struct Eigen2 {
  double low, high;
  Vector2 low_vector, high_vector;

  explicit Eigen2(const Symmetric2& A) {
    const double mean = 0.5 * A.trace();
    const double half_difference = 0.5 * (A.xx - A.yy);
    // The entries are scaled so that no square over- or underflows: between two vertices they are tiny.
    const double scale = std::max(std::abs(half_difference), std::abs(A.xy));
    const double cosine = scale > 0 ? half_difference / scale : 0;
    const double sine = scale > 0 ? A.xy / scale : 0;
    const double length = std::sqrt(cosine * cosine + sine * sine);
    const double radius = scale * length;
    // The eigenvalue of larger magnitude comes from the sum, the other from the determinant. Their difference would cancel: beside
    // a huge radius of curvature nothing would be left of a small one.
    const double large = mean >= 0 ? mean + radius : mean - radius;
    const double small = large != 0 ? A.xx * (A.yy / large) - A.xy * (A.xy / large) : 0;
    low = mean >= 0 ? small : large;
    high = mean >= 0 ? large : small;
    // There are two ways to write the eigenvector. This one has no cancellation.
    const Vector2 v = half_difference >= 0 ? Vector2(length + cosine, sine) : Vector2(sine, length - cosine);
    high_vector = scale > 0 ? Vector2(v.normalized()) : Vector2(1, 0);
    low_vector = Vector2(-high_vector.y(), high_vector.x());
  }
};

}  // namespace supernormal
