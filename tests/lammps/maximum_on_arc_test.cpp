// The search for a maximum on an arc, on functions with a closed form.
#include "kernel/maximum_on_arc.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace granular;

namespace {

/// The derivatives of cos(angle - top), and how often they were asked for.
struct Cosine {
  double top;
  int* evaluations;
  ArcSlope operator()(double angle) const {
    ++*evaluations;
    return {-std::sin(angle - top), -std::cos(angle - top)};
  }
};

/// A roof with a sharp ridge: the slope jumps, and the second derivative is no help.
ArcSlope roof(double angle) { return {angle < 0.3 ? 1.0 : -2.0, 0}; }

}  // namespace

TEST_CASE("lammps: the maximum of a cosine is found to rounding, by Newton's method") {
  for (const double top : {-0.9, -1e-7, 0.0, 0.123, 0.99}) {
    int evaluations = 0;
    CHECK(std::abs(find_maximum_on_arc(Cosine{top, &evaluations}, -1, 1) - top) < 1e-14);
    CHECK(evaluations <= 10);
  }
}

TEST_CASE("lammps: the uphill search finds a maximum up to half a turn away, on either side") {
  for (const double top : {-3.0, -1.5, -0.02, -1e-9, 0.0, 1e-9, 0.3, 1.6, 3.1}) {
    int evaluations = 0;
    CHECK(std::abs(find_maximum_uphill(Cosine{top, &evaluations}) - top) < 1e-14);
    CHECK(evaluations <= 16);
  }
}

TEST_CASE("lammps: a sharp ridge is found by bisection") {
  CHECK(std::abs(find_maximum_on_arc(roof, 0, 1) - 0.3) < 1e-13);
  CHECK(std::abs(find_maximum_uphill(roof) - 0.3) < 1e-13);
}

TEST_CASE("lammps: a slope that is only rounding, and a curvature that is infinite, leave the start") {
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(find_maximum_uphill([](double angle) { return ArcSlope{1e-300 - angle, -1}; }) == doctest::Approx(0).epsilon(1e-14));
  CHECK(std::abs(find_maximum_uphill([&](double angle) { return ArcSlope{angle > 0 ? -1.0 : 1e-18, -infinite}; })) < 1e-13);
}
