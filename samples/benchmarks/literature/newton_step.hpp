// The step of Newton's method for a small system of equations, and the tangents in its equations.
#pragma once

#include <Eigen/LU>
#include <array>
#include <limits>
#include <optional>

#include "superquadric.hpp"

namespace literature {

/// Solves jacobian·x = residual. Empty if the matrix is exactly singular or a number is not finite. A zero pivot does occur: both
/// bodies are flat at the contact, or an iterate is on a plane of symmetry.
template <int kSize>
std::optional<Eigen::Vector<double, kSize>> newton_step(const Eigen::Matrix<double, kSize, kSize>& jacobian,
                                                        const Eigen::Vector<double, kSize>& residual) {
  const Eigen::PartialPivLU<Eigen::Matrix<double, kSize, kSize>> lu(jacobian);
  if ((lu.matrixLU().diagonal().array() == 0).any()) return {};
  const Eigen::Vector<double, kSize> step = lu.solve(residual);
  if (!step.allFinite()) return {};
  return step;
}

/// The same, but for a singular matrix it solves the regular part and sets the undetermined unknowns to zero.
template <int kSize>
std::optional<Eigen::Vector<double, kSize>> newton_step_of_any_rank(const Eigen::Matrix<double, kSize, kSize>& jacobian,
                                                                    const Eigen::Vector<double, kSize>& residual) {
  if (const auto step = newton_step(jacobian, residual)) return step;
  if (!jacobian.allFinite()) return {};
  const Eigen::Vector<double, kSize> step = jacobian.fullPivLu().solve(residual);
  if (!step.allFinite()) return {};
  return step;
}

/// The second and third columns of the Householder matrix that maps a unit normal to the x-axis (Lopes et al. 2010, 2013), and
/// their derivatives by the normal.
struct Tangents {
  std::array<Vector3, 2> tangent;
  std::array<Matrix3, 2> rate;
};

Tangents tangents_of(const Vector3& normal);

/// A unit vector and its derivative, from a vector of any length with its derivative. NaN for a zero vector.
template <int kColumns>
struct Normalized {
  Vector3 vector;
  Eigen::Matrix<double, 3, kColumns> rate;

  Normalized(const Vector3& v, const Eigen::Matrix<double, 3, kColumns>& v_rate) {
    double length = v.norm();
    if (length == 0) length = std::numeric_limits<double>::quiet_NaN();
    vector = v / length;
    rate = (v_rate - vector * (vector.transpose() * v_rate)) / length;
  }
};

}  // namespace literature
