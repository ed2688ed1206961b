#include "proximity/local/first_guess.hpp"

#include <Eigen/Geometry>

#include "proximity/gap/limits.hpp"

namespace supernormal {
namespace {

/// The axis along which the body is thinnest. Along it the shortest translation separates concentric bodies.
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
  const double size1 = half1.norm(), size2 = half2.norm(), sum = size1 + size2;
  const double distance = gap.offset().norm();
  if (distance <= limits::kConcentric * sum) {
    return half1.minCoeff() <= half2.minCoeff() ? thinnest_axis(half1) : Vector3(R * thinnest_axis(half2));
  }
  const Vector3 direction = gap.offset() / distance;
  if (sum == 0) return direction;  // two points
  // The squares of the half-extents over the body's size, scaled so that the two matrices together have the trace 1. A point gives
  // zero.
  const double scale = 1 / sum;
  const auto squares_over_size = [scale](const Vector3& half, double size) -> Vector3 {
    return size > 0 ? half.cwiseProduct(half * (scale / size)) : Vector3(Vector3::Zero());
  };
  Matrix3 M = R * squares_over_size(half2, size2).asDiagonal() * R.transpose();
  M.diagonal() += squares_over_size(half1, size1);
  // The inverse up to the determinant, which vanishes for a segment and a point.
  const Vector3 column = M.col(1).cross(M.col(2));
  if (!(M.col(0).dot(column) > limits::kSingularGuess)) return direction;
  return Vector3(column.dot(direction), M.col(2).cross(M.col(0)).dot(direction), M.col(0).cross(M.col(1)).dot(direction))
      .normalized();
}

}  // namespace supernormal
