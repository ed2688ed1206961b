// How well data determine the numbers of a body.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "distance.hpp"

namespace fit {

/// One standard error for each number of a body, in the order of kPosition to kTaper: position and half-axes in the unit of the
/// data, rotation in rad about the body's axes, exponents and taper as such.
struct Uncertainty {
  Gradient standard_error = Gradient::Zero();
  std::array<bool, kParameters> is_determined{};  ///< false: the data say nothing about it, its value is arbitrary
  double sigma = 0;                               ///< standard deviation of the distances
  /// The mean square of the distances' means over patches of the surface, over what independent distances would give. 1 where the
  /// body is of the right family; above, neighbouring distances agree with one another, and count for less than their number.
  double lack_of_fit = 1;
  bool is_significant = false;  ///< whether lack_of_fit is too large for chance; standard errors are then larger by its root
};

using SquareMatrix = Eigen::Matrix<double, kParameters, kParameters>;

/// J^T J: the sum of g g^T over the gradients g of the distances. A family varies the first of the numbers.
SquareMatrix normal_matrix(const DistanceFunction& function, std::span<const Witness> witnesses);

/// From the distances of the points that were fitted, less what they should be (`residuals`).
///
/// The covariance of least squares is sigma^2 (J^T J)^-1 with the Jacobian J at the solution (Seber and Wild, Nonlinear Regression,
/// section 2.1). A number is not determined where a direction of J^T J without weight has a share in it (a body of revolution may
/// turn about its axis), or where its standard error is as large as the number itself could be.
Uncertainty find_uncertainty(const Body& body, std::span<const Witness> witnesses, std::span<const double> residuals);

}  // namespace fit
