#include "compare.hpp"

#include <algorithm>
#include <cmath>

namespace fit {

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
