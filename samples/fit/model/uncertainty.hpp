// The uncertainty of the parameters of a body.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "distance.hpp"

namespace fit {

/// One standard error for each parameter, in the order of kPosition to kTaper. Position and half-axes: unit of the data. Rotation:
/// rad, about the body's axes. Exponents and taper: as such.
struct Uncertainty {
  Gradient standard_error = Gradient::Zero();
  std::array<bool, kParameters> is_fixed{};       ///< by ShapeLimits: without an error
  std::array<bool, kParameters> is_determined{};  ///< false: the data do not determine it, its value is arbitrary
  double sigma = 0;                               ///< standard deviation of the distances
  /// The mean square of the patch means of the distances, relative to its value for independent distances. It is 1 for a body of
  /// the right family. If it is larger, neighbouring distances are correlated and count for less than their number.
  double lack_of_fit = 1;
  /// Of position (unit of the data), rotation, ln half-axes, ln (exponents - 1) and taper, without the undetermined directions.
  Eigen::Matrix<double, kParameters, kParameters> covariance = Eigen::Matrix<double, kParameters, kParameters>::Zero();
  bool is_significant = false;  ///< whether lack_of_fit is too large for chance; standard errors then include its square root
};

using SquareMatrix = Eigen::Matrix<double, kParameters, kParameters>;

/// J^T J: the sum of g g^T over the gradients g of the distances. A family uses the leading parameters.
SquareMatrix normal_matrix(const DistanceFunction& function, std::span<const Witness> witnesses);

/// Computes the uncertainty from `residuals`: the distances of the fitted points minus their target distances.
///
/// The covariance of least squares is sigma^2 (J^T J)^-1 with the Jacobian J at the solution (Seber and Wild, Nonlinear Regression,
/// section 2.1). A parameter is undetermined if it contributes to a null direction of J^T J: a body of revolution may rotate about
/// its axis. It is also undetermined if its standard error is as large as its range.
Uncertainty find_uncertainty(const Body& body, std::span<const Witness> witnesses, std::span<const double> residuals,
                             const ShapeLimits& limits = {});

}  // namespace fit
