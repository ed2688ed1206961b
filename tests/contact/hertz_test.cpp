#include "supernormal/contact/hertz.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "support/relative.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// A contact with an ellipse of half-axes 1 and b, under a pressure of 1 in its middle, on bodies of modulus 1: Johnson,
/// section 3.3.
struct Ellipse {
  explicit Ellipse(double b) {
    const double e = std::sqrt(1 - b * b);
    const double K = std::comp_ellint_1(e), E = std::comp_ellint_2(e);
    const double A = b / (e * e) * (K - E), B = b / (e * e) * (E / (b * b) - K);  // half of the relative curvature along each axis
    const double force = 2.0 / 3 * std::numbers::pi * b;
    const double round_depth = std::cbrt(9.0 / 16 * force * force * 2 * std::sqrt(A * B));
    ratio = B / A;
    correction = b * K / round_depth;
  }
  double ratio, correction;
};

/// The same by the arithmetic-geometric mean in long double. K - E comes from its sum: the difference would cancel.
struct PreciseEllipse {
  explicit PreciseEllipse(long double b) {
    long double mean = 1, geometric = b, sum = (1 - b) * (1 + b) / 2, weight = 1;
    for (int i = 0; i < 10; ++i) {
      const long double half = (mean - geometric) / 2, next = (mean + geometric) / 2;
      geometric = std::sqrt(mean * geometric);
      mean = next;
      sum += weight * half * half;
      weight *= 2;
    }
    const long double K = std::numbers::pi_v<long double> / (2 * mean), E = K * (1 - sum), e2 = (1 - b) * (1 + b);
    const long double A = b / e2 * K * sum, B = b / e2 * (E / (b * b) - K);
    const long double force = 2.0L / 3 * std::numbers::pi_v<long double> * b;
    ratio = B / A;
    correction = b * K / std::cbrt(9.0L / 16 * force * force * 2 * std::sqrt(A * B));
  }
  long double ratio, correction;
};

/// The rebound velocity of an impact of a unit mass at velocity 1 on F = x^(3/2) with the damper of ratio b, by short Euler steps.
double rebound(double b) {
  constexpr double kEulerStep = 1e-6;
  double x = 0, v = 1;
  while (true) {
    x += kEulerStep * v;
    const double stiffness = 1.5 * std::sqrt(std::fmax(x, 0));
    const double force = x * stiffness / 1.5 + 2 * b * std::sqrt(5.0 / 6 * stiffness) * v;
    if (force <= 0 || x <= 0) return -v;
    v -= kEulerStep * force;
  }
}

}  // namespace

TEST_CASE("Hertz: the correction of elliptic contacts agrees with the elliptic integrals") {
  CHECK(hertz_correction(1) == 1);
  for (const double axes : {0.95, 0.6, 0.2, 0.03, 0.001}) {
    const Ellipse ellipse(axes);
    CAPTURE(ellipse.ratio);
    CHECK(hertz_correction(ellipse.ratio) == relative(ellipse.correction).epsilon(1e-8));
  }
}

TEST_CASE("Hertz: the correction has a relative error of 1e-12, for axes down to 1e-6 of each other") {
  constexpr int kCount = 20000;
  double largest = 0;
  double last = 1;
  for (int k = 1; k <= kCount; ++k) {
    const PreciseEllipse ellipse(std::pow(10.0L, -6.0L * k / kCount));
    const double found = hertz_correction(static_cast<double>(ellipse.ratio));
    largest = std::max(largest, static_cast<double>(std::abs(found / ellipse.correction - 1)));
    CHECK(found <= last + 1e-12);
    last = found;
  }
  MESSAGE("largest relative error: " << largest);
  CHECK(largest < 1e-12);
}

TEST_CASE("Hertz: an impact with the damping for a restitution rebounds with it") {
  CHECK(hertz_damping_ratio(1) == 0);
  for (const double restitution : {0.05, 0.3, 0.6, 0.9, 0.99}) {
    CAPTURE(restitution);
    CHECK(std::abs(rebound(hertz_damping_ratio(restitution)) - restitution) < 2e-4);
  }
}
