// The maximum of a function of an angle.
#pragma once

#include <cmath>

namespace granular {

/// The derivatives of a function of an angle.
struct ArcSlope {
  double first, second;
};

/// The angle (rad) of a maximum between two angles. The slope must be positive at the first and not positive at the second.
/// Newton's method, safeguarded by bisection: flat faces reverse the slope within a very small angle.
template <typename Slope>
double find_maximum_on_arc(const Slope& slope, double low, double high) {
  constexpr int kMaxSteps = 100;
  constexpr double kSameAngle = 1e-14;  // rad
  double angle = 0.5 * (low + high), last_step = high - low;
  for (int i = 0; i < kMaxSteps && high - low > kSameAngle; ++i) {
    const ArcSlope here = slope(angle);
    (here.first > 0 ? low : high) = angle;
    const double step = -here.first / here.second;
    const bool is_good = here.second < 0 && std::abs(step) < 0.5 * last_step && angle + step > low && angle + step < high;
    const double next = is_good ? angle + step : 0.5 * (low + high);
    last_step = std::abs(next - angle);
    angle = next;
    if (last_step <= kSameAngle) break;
  }
  return angle;
}

}  // namespace granular
