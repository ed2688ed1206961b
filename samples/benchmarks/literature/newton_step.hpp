// The step of Newton's method for a small system of equations.
#pragma once

#include <Eigen/LU>
#include <optional>

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

}  // namespace literature
