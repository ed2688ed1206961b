#include "supernormal/contact/hertz.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "contact/hertz_coefficients.hpp"

namespace supernormal {
namespace {

struct EllipticIntegrals {
  double K, E;
};

/// The complete elliptic integrals for the axis ratio k' = b/a, by the arithmetic-geometric mean (Abramowitz and Stegun, 17.6).
EllipticIntegrals elliptic_integrals(double axis_ratio) {
  double a = 1;
  double b = axis_ratio;
  double sum = 0.5 * (1 - axis_ratio * axis_ratio);
  double weight = 1;
  for (int i = 0; i < 12 && std::abs(a - b) > 1e-16 * a; ++i) {
    const double c = 0.5 * (a - b);
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
    sum += weight * c * c;
    weight *= 2;
  }
  const double K = std::numbers::pi / (2 * a);
  return {K, K * (1 - sum)};
}

/// The rebound velocity of an impact with unit mass, stiffness and velocity: x'' = -x^(3/2) - sqrt(5) b x^(1/4) x', by the
/// Runge-Kutta method.
double rebound(double b) {
  constexpr double kStep = 0.002;
  const double factor = std::sqrt(5.0) * b;
  const auto force = [&](double x, double v) {
    const double root = std::sqrt(std::fmax(x, 0));
    return x * root + factor * std::sqrt(root) * v;
  };
  double x = 0;
  double v = 1;
  // At x = 0 the slope of the damping force is infinite. A short first step without damping is exact enough.
  x = 1e-6;
  while (true) {
    const double f1 = force(x, v);
    if (f1 <= 0) return -v;
    const double f2 = force(x + 0.5 * kStep * v, v - 0.5 * kStep * f1);
    const double f3 = force(x + 0.5 * kStep * (v - 0.5 * kStep * f1), v - 0.5 * kStep * f2);
    const double f4 = force(x + kStep * (v - 0.5 * kStep * f2), v - kStep * f3);
    x += kStep * (v - kStep / 6 * (f1 + f2 + f3));
    v -= kStep / 6 * (f1 + 2 * f2 + 2 * f3 + f4);
  }
}

/// Solves (a/b)^2 E - K = ratio (K - E) for the axis ratio. It is nearly a power law, so the secant method on the logarithms
/// converges.
double solve_correction(double ratio) {
  const auto excess = [&](double log_axes) {
    const double k = std::exp(log_axes);
    const auto [K, E] = elliptic_integrals(k);
    return std::log((E / (k * k) - K) / (K - E)) - std::log(ratio);
  };
  double x = -2.0 / 3 * std::log(ratio);
  double f = excess(x);
  double slope = -1.6;
  for (int i = 0; i < 30 && std::abs(f) > 1e-12; ++i) {
    const double step = -f / slope;
    const double next = excess(x + step);
    slope = (next - f) / step;
    x += step;
    f = next;
  }
  const double k = std::exp(x);
  const auto [K, E] = elliptic_integrals(k);
  const double F1 = std::cbrt(4 / (std::numbers::pi * (1 - k * k)) * k * std::sqrt(k) * std::sqrt((E / (k * k) - K) * (K - E)));
  return 2 / std::numbers::pi * std::sqrt(k) / F1 * K;
}

}  // namespace

double hertz_correction(double ratio) {
  if (ratio < 1 + 1e-6) return 1;
  constexpr double kLargest = std::uint64_t{1} << (2 * kHertzOctaves);
  if (!(ratio < kLargest)) return solve_correction(ratio);
  const auto bits = std::bit_cast<std::uint64_t>(std::sqrt(ratio));
  constexpr auto kOne = std::bit_cast<std::uint64_t>(1.0);
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;
  const HertzOctave& octave = kHertzTable[(bits - kOne) >> 52];
  const double t = std::bit_cast<double>((bits & kMantissa) | kOne) - 1;
  double P = octave.P[kHertzDegree];
  double Q = octave.Q[kHertzDegree - 1];
  for (int i = kHertzDegree - 1; i >= 0; --i) {
    P = P * t + octave.P[i];
    Q = Q * t + (i > 0 ? octave.Q[i - 1] : 1);
  }
  return std::min(1.0, P / Q);  // the rounding of a nearly round contact may lead beyond
}

double hertz_damping_ratio(double restitution) {
  if (restitution >= 1) return 0;
  double low = 0;
  double high = 4;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (rebound(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace supernormal
