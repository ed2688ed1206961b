// The step of Newton's method for a system of a few equations.
#pragma once

#include <Eigen/LU>
#include <optional>

namespace literature {

/// The x with jacobian·x = residual; nothing where the matrix is singular to the bit or a number is not finite. A pivot of exactly
/// zero occurs: both bodies are flat where they would meet, or an iterate is on a plane of symmetry.
template <int kSize>
std::optional<Eigen::Vector<double, kSize>> newton_step(const Eigen::Matrix<double, kSize, kSize>& jacobian,
                                                        const Eigen::Vector<double, kSize>& residual) {
  const Eigen::PartialPivLU<Eigen::Matrix<double, kSize, kSize>> lu(jacobian);
  if ((lu.matrixLU().diagonal().array() == 0).any()) return {};
  const Eigen::Vector<double, kSize> step = lu.solve(residual);
  if (!step.allFinite()) return {};
  return step;
}

/// The same; where the matrix is singular, the x of its regular part, with zeros for the unknowns that it leaves open.
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
