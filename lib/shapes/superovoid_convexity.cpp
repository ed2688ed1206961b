// The body is convex if the width of its section at the height s = z/c, g(s) = w(s) N(s), is concave in s for every direction (A,
// B) in the section. Here w(s) = (1 - |s|^epsilon)^(1/epsilon) and
//     N = |(A X, B Y)|_p,   X = 1 + taper_x s,   Y = 1 + taper_y s.
// Let u = (A X)^p / N^p and v = 1 - u be the fractions of the two sides, and rx = taper_x / X, ry = taper_y / Y their relative
// slopes. Then
//     N'/N = u rx + v ry,   N''/N = (p - 1) u v (rx - ry)^2.
// The condition -g'' >= 0, times (1 - |s|^epsilon)^2 |s|^(2 - epsilon) / g, is
//     (epsilon - 1) + 2 s (1 - |s|^epsilon) (u rx + v ry) - (p - 1) u v (rx - ry)^2 |s|^(2 - epsilon) (1 - |s|^epsilon)^2 >= 0
// for all s in [-1, 1] and u in [0, 1]. For equal tapers the last term is 0, and the rest is least where |s|^epsilon = 1/2. For
// different tapers and epsilon > 2 the last term is unbounded at s = 0.
#include "shapes/superovoid_convexity.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/validation.hpp"

namespace supernormal {
namespace {

constexpr int kSamples = 2048;  // number of heights

/// The left side of the inequality above at height s, for the worst direction in the section.
double margin_at(double s, double delta, double epsilon, double taper_x, double taper_y) {
  const double height = std::abs(s);
  const double remainder = 1 - std::pow(height, epsilon);
  const double rx = taper_x / (1 + taper_x * s);
  const double ry = taper_y / (1 + taper_y * s);
  // (epsilon - 1) + slope (ry + u (rx - ry)) - bend u (1 - u) is a parabola in u, open upwards.
  const double slope = 2 * s * remainder;
  const double bend = (rx - ry) * (rx - ry) / (delta - 1) * std::pow(height, 2 - epsilon) * remainder * remainder;
  const double tilt = slope * (rx - ry);
  const double u = bend > 0 ? std::clamp(0.5 * (1 - tilt / bend), 0.0, 1.0) : (tilt > 0 ? 0.0 : 1.0);
  return (epsilon - 1) + slope * ry + u * tilt - bend * u * (1 - u);
}

std::string both(double taper_x, double taper_y) { return "taper_x = " + to_text(taper_x) + " and taper_y = " + to_text(taper_y); }

}  // namespace

// Stored, because x87 returns more digits than a double has: the caller's double could then be beyond the limit.
double largest_convex_taper(double epsilon) {
  const volatile double limit = std::exp2(1 / epsilon) * ((epsilon - 1) / epsilon);
  return limit;
}

TaperedConvexity least_convex(double delta, double epsilon, double taper_x, double taper_y) {
  const auto margin = [&](double s) { return margin_at(s, delta, epsilon, taper_x, taper_y); };
  const auto height = [](int i) { return -1 + 2.0 * i / kSamples; };
  int lowest = 0;
  for (int i = 1; i <= kSamples; ++i) {
    if (margin(height(i)) < margin(height(lowest))) lowest = i;
  }
  // Golden-section search between the neighbours of the lowest sample.
  constexpr double kGolden = 0.6180339887498949;
  double low = height(std::max(lowest - 1, 0)), high = height(std::min(lowest + 1, kSamples));
  for (int i = 0; i < 50; ++i) {
    const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    (margin(left) < margin(right) ? high : low) = margin(left) < margin(right) ? right : left;
  }
  const double between = 0.5 * (low + high);
  const double best = margin(between) < margin(height(lowest)) ? between : height(lowest);
  return {best, margin(best)};
}

void require_convex_taper(double delta, double epsilon, double taper_x, double taper_y) {
  const double largest = largest_convex_taper(epsilon);
  const char* const names[] = {"taper_x", "taper_y"};
  const double tapers[] = {taper_x, taper_y};
  for (int axis = 0; axis < 2; ++axis) {
    if (std::islessequal(std::abs(tapers[axis]), largest)) continue;  // false for NaN, without a floating-point exception
    throw std::invalid_argument(std::string(names[axis]) + " = " + to_text(tapers[axis]) + " is outside [" + to_text(-largest) +
                                ", " + to_text(largest) + "], where a body with epsilon = " + to_text(epsilon) +
                                " is convex: |taper| <= 2^(1/epsilon) (epsilon - 1)/epsilon");
  }
  if (taper_x == taper_y) return;
  if (epsilon > 2) {
    throw std::invalid_argument(both(taper_x, taper_y) + " differ, but with epsilon = " + to_text(epsilon) +
                                " a body is convex only if they are equal: above 2 it has straight sides, which different tapers "
                                "twist");
  }
  const TaperedConvexity worst = least_convex(delta, epsilon, taper_x, taper_y);
  if (worst.margin >= 0) return;
  throw std::invalid_argument(both(taper_x, taper_y) + " with delta = " + to_text(delta) + " and epsilon = " + to_text(epsilon) +
                              ": not convex, because the width of the section in some direction is not a concave function of z "
                              "at z = " +
                              to_text(worst.height) + " c; smaller or less different tapers make it one");
}

}  // namespace supernormal
