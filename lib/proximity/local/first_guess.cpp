#include "proximity/local/first_guess.hpp"

#include <Eigen/LU>
#include <cmath>

namespace supernormal {
namespace {

// Centres closer than this share of the bodies' size have no direction from one to the other.
constexpr double kConcentric = 1e-12;

// Share of the cube of the trace below which a determinant counts as none: the squares of the inverse are finite.
constexpr double kSingular = 1e-150;

/// The axis along which the body is thinnest: there the smallest translation separates concentric bodies.
Vector3 thinnest_axis(const Vector3& half_extents) {
  int axis = 0;
  half_extents.minCoeff(&axis);
  return Vector3::Unit(axis);
}

}  // namespace

Vector3 first_guess(const GapFunction& gap) {
  const Vector3 half1 = gap.shape1().half_extents();
  const Vector3 half2 = gap.shape2().half_extents();
  const Matrix3& R = gap.rotation();
  const double size1 = half1.norm();
  const double size2 = half2.norm();
  if (gap.offset().norm() <= kConcentric * (size1 + size2)) {
    return half1.minCoeff() <= half2.minCoeff() ? thinnest_axis(half1) : Vector3(R * thinnest_axis(half2));
  }
  // Divided by the sizes so that a point, of size 0, needs no case of its own.
  const Matrix3 A = half1.cwiseProduct(half1).asDiagonal();
  const Matrix3 B = R * half2.cwiseProduct(half2).asDiagonal() * R.transpose();
  const double sum = size1 + size2;
  const Vector3 direction = gap.offset().normalized();
  if (sum == 0) return direction;  // two points
  const Matrix3 M = size1 == 0 ? B : size2 == 0 ? A : Matrix3(A * (sum / size1) + B * (sum / size2));
  // Of a segment and a point it is singular; so it may be of lengths whose squares are no longer numbers.
  const double trace = M.trace();
  if (!(trace > 0)) return direction;
  Matrix3 inverse;
  bool is_invertible = false;
  Matrix3(M / trace).computeInverseWithCheck(inverse, is_invertible, kSingular);
  return is_invertible ? Vector3((inverse * direction).normalized()) : direction;
}

}  // namespace supernormal
