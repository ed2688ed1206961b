#include "truth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bodies.hpp"
#include "input/sampling.hpp"

namespace fit {

double NormalNumbers::operator()() {
  const double u = 1 - uniform(random_), v = uniform(random_);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

double mean_half_axis(const Body& body) { return std::cbrt(body.half_axes.prod()); }

Cloud scatter(const Body& truth, const Scatter& settings) {
  const std::size_t wanted = settings.points;
  // About half of the points are removed: sample slightly more than twice as many.
  const std::size_t made = settings.is_half_missing ? 2 * wanted + wanted / 2 + 50 : wanted;
  const Cloud surface = sample_boundary(*make_shape(truth), made, settings.seed);
  NormalNumbers normal(settings.seed + 1000);
  const double sigma = settings.noise * mean_half_axis(truth);
  const Matrix3 R = truth.rotation();
  const Vector3 side = Vector3(1, 0.6, -0.5).cwiseQuotient(truth.half_axes);
  Cloud cloud;
  for (std::size_t i = 0; i < surface.points.size() && cloud.points.size() < wanted; ++i) {
    if (settings.is_half_missing && side.dot(surface.points[i]) < 0) continue;
    const double x = normal(), y = normal(), z = normal();
    cloud.points.emplace_back(truth.position + R * surface.points[i] + sigma * Vector3(x, y, z));
    if (settings.has_normals) cloud.normals.emplace_back(R * surface.normals[i]);
  }
  return cloud;
}

Body aligned(const Body& fitted, const Body& truth, Eigen::Matrix3d& axes) {
  const bool z_is_free = truth.delta == truth.epsilon && truth.taper == 0;
  constexpr std::array<std::array<int, 3>, 6> kPermutations = {{{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}};
  double largest = -4;
  axes.setIdentity();
  for (const auto& permutation : kPermutations) {
    if (permutation[2] != 2 && !z_is_free) continue;
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3 candidate = Matrix3::Zero();
      for (int k = 0; k < 3; ++k) candidate(permutation[static_cast<std::size_t>(k)], k) = ((signs >> k) & 1) != 0 ? -1 : 1;
      if (candidate.determinant() < 0) continue;
      const double trace = (truth.rotation().transpose() * fitted.rotation() * candidate).trace();
      if (trace <= largest) continue;
      largest = trace;
      axes = candidate;
    }
  }
  Body result = fitted;
  result.orientation = Eigen::Quaterniond(fitted.rotation() * axes).normalized();
  result.half_axes = axes.cwiseAbs().transpose() * fitted.half_axes;
  if (axes(2, 2) < 0) result.taper = -fitted.taper;
  return result;
}

Eigen::Matrix<double, kParameters, 1> deviation(const Body& fitted, const Body& truth) {
  Eigen::Matrix<double, kParameters, 1> result;
  result.segment<3>(kPosition) = fitted.position - truth.position;
  const Eigen::AngleAxisd turn(truth.rotation().transpose() * fitted.rotation());
  result.segment<3>(kRotation) = turn.angle() * turn.axis();
  result.segment<3>(kLogAxes) = fitted.half_axes - truth.half_axes;
  result[kLogDelta] = fitted.delta - truth.delta;
  result[kLogEpsilon] = fitted.epsilon - truth.epsilon;
  result[kTaper] = fitted.taper - truth.taper;
  return result;
}

Compared compare(const FittedBody& fitted, const Body& truth) {
  Compared result;
  Eigen::Matrix3d axes;
  result.body = aligned(fitted.body, truth, axes);
  result.deviation = deviation(result.body, truth);
  result.standard_error = fitted.uncertainty.standard_error;
  result.is_determined = fitted.uncertainty.is_determined;
  result.is_edge_below_noise = fitted.is_edge_below_noise;
  const Eigen::Matrix3d from = axes.cwiseAbs().transpose();
  for (const int first : {kRotation, kLogAxes}) {
    result.standard_error.segment<3>(first) = from * fitted.uncertainty.standard_error.segment<3>(first);
    for (int i = first; i < first + 3; ++i) {
      Eigen::Index source = 0;
      from.row(i - first).maxCoeff(&source);
      result.is_determined[static_cast<std::size_t>(i)] =
          fitted.uncertainty.is_determined[static_cast<std::size_t>(first + source)];
    }
  }
  constexpr double kOtherAxes = 0.6;  // rad; 45 degrees are 0.79
  for (int i = kRotation; i < kRotation + 3; ++i) {
    const bool counts = result.is_determined[static_cast<std::size_t>(i)];
    if (counts && std::abs(result.deviation[i]) > kOtherAxes) result.has_other_axes = true;
  }
  return result;
}

Compared fit_and_compare(const Body& truth, const Scatter& scatter_settings) {
  FitSettings settings;
  settings.family = truth.family;
  return compare(fit_body(scatter(truth, scatter_settings), settings), truth);
}

}  // namespace fit
