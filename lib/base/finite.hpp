// Tests for infinite and NaN values that raise no floating-point exceptions.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace supernormal {

/// Replaces Eigen's allFinite(), which subtracts every entry from itself and so raises FE_INVALID for an infinite entry.
template <typename Derived>
bool all_finite(const Eigen::MatrixBase<Derived>& matrix) {
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      if (!std::isfinite(matrix(row, column))) return false;
    }
  }
  return true;
}

/// Whether no |entry| is larger than `limit`; false for a NaN.
template <typename Derived>
bool all_within(const Eigen::MatrixBase<Derived>& matrix, double limit) {
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      if (!std::islessequal(std::abs(matrix(row, column)), limit)) return false;
    }
  }
  return true;
}

/// Whether |numerator / denominator| < `limit`, without the division, which might overflow. False if both are zero.
inline bool is_quotient_within(double numerator, double denominator, double limit) {
  return std::abs(numerator) < limit * std::abs(denominator);
}

}  // namespace supernormal
