// The maximum of a function of an angle.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace granular {

/// The derivatives of a function of an angle.
struct ArcSlope {
  double first, second;
};

/// The angle (rad) of a maximum between two angles. The slope must be positive at the first and not positive at the second.
/// Newton's method, safeguarded by bisection: flat faces reverse the slope within a very small angle.
double find_maximum_on_arc(const auto& slope, double low, double high) {
  constexpr int kMaxSteps = 100;
  constexpr double kSameAngle = 1e-14;  // rad
  double angle = 0.5 * (low + high), last_step = high - low;
  for (int i = 0; i < kMaxSteps && high - low > kSameAngle; ++i) {
    const ArcSlope here = slope(angle);
    if (here.first == 0) break;
    (here.first > 0 ? low : high) = angle;
    const double step = here.second < 0 ? -here.first / here.second : last_step;
    const bool is_good = std::abs(step) < 0.5 * last_step && angle + step > low && angle + step < high;
    const double next = is_good ? angle + step : 0.5 * (low + high);
    last_step = std::abs(next - angle);
    angle = next;
    if (last_step <= kSameAngle) break;
  }
  return angle;
}

/// The maximum uphill from 0, at most half a turn away.
double find_maximum_uphill(const auto& slope) {
  constexpr double kFirstStep = 0.01;  // rad; without a step of Newton's method
  const ArcSlope here = slope(0);
  if (here.first == 0) return 0;
  const double uphill = here.first > 0 ? 1 : -1, newton = here.second < 0 ? std::abs(here.first / here.second) : 0;
  double last = 0, next = newton > 0 ? std::min(2 * newton, 1.0) : kFirstStep;
  while (next < std::numbers::pi && uphill * slope(uphill * next).first > 0) {
    last = next;
    next = std::min(4 * next, std::numbers::pi);
  }
  return find_maximum_on_arc(slope, uphill > 0 ? last : -next, uphill > 0 ? next : -last);
}

}  // namespace granular
