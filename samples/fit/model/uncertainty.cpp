#include "uncertainty.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "cloud.hpp"

namespace fit {
namespace {

// Relative to the size of the body: the accuracy of distances, and the level below which residuals are patterned rounding errors.
constexpr double kExact = 1e-12, kExactFit = 1e-9;

/// The F statistic of the test for lack of fit: the mean square of the patch means over the mean square within the patches (Draper
/// and Smith, Applied Regression Analysis, section 2.1). A patch is the surface around one of 100 directions from the centre.
void test_lack_of_fit(const Body& body, std::span<const Witness> witnesses, std::span<const double> residuals,
                      Uncertainty& result) {
  const auto points = static_cast<double>(residuals.size());
  const int parameters = parameter_count(body.family);
  const std::vector<Vector3> directions = spread_directions(std::min(100, static_cast<int>(points / 8)));
  if (directions.size() < 2 * static_cast<std::size_t>(parameters)) return;
  const Matrix3 to_body = body.half_axes.cwiseInverse().asDiagonal() * body.rotation().transpose();
  std::vector<double> sums(directions.size()), counts(directions.size());
  double square = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const Vector3 direction = to_body * (witnesses[i].foot - body.position);
    const auto nearest =
        std::ranges::max_element(directions, {}, [&](const Vector3& candidate) { return candidate.dot(direction); });
    const auto patch = static_cast<std::size_t>(nearest - directions.begin());
    sums[patch] += residuals[i];
    counts[patch] += 1;
    square += residuals[i] * residuals[i];
  }
  double between = 0, patches = 0;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (counts[k] == 0) continue;
    between += sums[k] * sums[k] / counts[k];
    patches += 1;
  }
  const double within = (square - between) / (points - patches), freedom = patches - parameters;
  if (!(within > 0) || !(freedom > 0)) return;
  result.lack_of_fit = between / freedom / within;
  // For random residuals the statistic has mean 1 and about this standard deviation.
  result.is_significant = result.lack_of_fit > 1 + 4 * std::sqrt(2 / freedom);
}

/// The largest standard error of a determined parameter: a third of the size, 10 degrees, half of a half-axis, a factor of e in
/// (exponent - 1), half of the taper's range.
Gradient largest_errors(const Body& body) {
  Gradient largest;
  largest.segment<3>(kPosition).setConstant(body.half_axes.maxCoeff() / 3);
  largest.segment<3>(kRotation).setConstant(std::numbers::pi / 18);
  largest.segment<3>(kLogAxes).setConstant(0.5);
  largest[kLogDelta] = largest[kLogEpsilon] = 1;
  largest[kTaper] = 0.35;
  return largest;
}

}  // namespace

SquareMatrix normal_matrix(const DistanceFunction& function, std::span<const Witness> witnesses) {
  SquareMatrix sum = SquareMatrix::Zero();
  for (const Witness& witness : witnesses) {
    const Gradient gradient = function.gradient(witness);
    sum += gradient * gradient.transpose();
  }
  return sum;
}

Uncertainty find_uncertainty(const Body& body, std::span<const Witness> witnesses, std::span<const double> residuals,
                             const ShapeLimits& limits) {
  Uncertainty result;
  result.is_fixed = fixed_parameters(limits);
  const double size = body.half_axes.maxCoeff();
  SquareMatrix all = normal_matrix(DistanceFunction(body), witnesses);
  all.middleRows<3>(kPosition) *= size;  // as lengths, so that eigenvalues are comparable
  all.middleCols<3>(kPosition) *= size;
  if (limits.has_round_section) {  // b follows a
    all.row(kLogAxes) += all.row(kLogAxes + 1).eval();
    all.col(kLogAxes) += all.col(kLogAxes + 1).eval();
  }
  for (int i = 0; i < kParameters; ++i) {
    if (!result.is_fixed[static_cast<std::size_t>(i)]) continue;
    all.row(i).setZero();
    all.col(i).setZero();
  }
  const double square = std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
  const int parameters = parameter_count(body.family);
  const double freedom = std::max(1.0, static_cast<double>(residuals.size()) - parameters);
  result.sigma = std::max(std::sqrt(square / freedom), kExact * size);
  if (result.sigma > kExactFit * size) test_lack_of_fit(body, witnesses, residuals, result);

  const Eigen::MatrixXd reduced = all.topLeftCorner(parameters, parameters);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(reduced);
  constexpr double kNoWeight = 1e-9;  // relative to the largest eigenvalue; the derivatives are accurate to about 1e-6
  constexpr double kShare = 1e-2;
  const double threshold = kNoWeight * eigen.eigenvalues().maxCoeff();
  SquareMatrix covariance = SquareMatrix::Zero();
  result.is_determined.fill(true);
  for (int k = 0; k < parameters; ++k) {
    const Eigen::VectorXd direction = eigen.eigenvectors().col(k);
    const bool has_weight = eigen.eigenvalues()[k] > threshold;
    if (has_weight) covariance.topLeftCorner(parameters, parameters) += direction * direction.transpose() / eigen.eigenvalues()[k];
    for (int i = 0; i < parameters; ++i) {
      if (!has_weight && std::abs(direction[i]) > kShare) result.is_determined[static_cast<std::size_t>(i)] = false;
    }
  }
  if (limits.has_round_section) {
    covariance.row(kLogAxes + 1) = covariance.row(kLogAxes).eval();
    covariance.col(kLogAxes + 1) = covariance.col(kLogAxes).eval();
  }
  covariance.middleRows<3>(kPosition) *= size;
  covariance.middleCols<3>(kPosition) *= size;
  const double scale = result.sigma * (result.is_significant ? std::sqrt(result.lack_of_fit) : 1);
  result.covariance = scale * scale * covariance;
  result.standard_error = result.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Gradient largest = largest_errors(body);
  for (int i = 0; i < parameters; ++i) {
    if (result.standard_error[i] > largest[i]) result.is_determined[static_cast<std::size_t>(i)] = false;
  }
  result.standard_error.segment<3>(kLogAxes) = result.standard_error.segment<3>(kLogAxes).cwiseProduct(body.half_axes).eval();
  result.standard_error[kLogDelta] *= body.delta - 1;
  result.standard_error[kLogEpsilon] *= body.epsilon - 1;
  return result;
}

}  // namespace fit
