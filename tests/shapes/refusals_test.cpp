// Tests that constructors refuse invalid bodies, and name the parameter, its value and its range.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/refusal.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string refusal_of_axes(double a, double b, double c) {
  std::string ellipsoid = refusal([&] { Ellipsoid{Vector3(a, b, c)}; });
  CHECK(refusal([&] { Superellipsoid(Vector3(a, b, c), 3, 3); }) == ellipsoid);
  return ellipsoid;
}

}  // namespace

TEST_CASE("half-axes outside the range are refused by name") {
  CHECK(refusal_of_axes(0, 1, 1) == "half-axis a = 0 m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1, -2.5, 1) == "half-axis b = -2.5 m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1, 1, kNan) == "half-axis c = nan m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1, kInfinity, 1) == "half-axis b = inf m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(5e-324, 1, 1) == "half-axis a = 5e-324 m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1, 1, 1e31) == "half-axis c = 1e+31 m is outside [1e-30, 1e+30] m");
  CHECK(refusal_of_axes(1e-30, 1, 1e30).empty());
}

TEST_CASE("exponents outside the range are refused by name") {
  const Vector3 axes(3, 2, 1);
  CHECK(refusal([&] { Superellipsoid(axes, 0.9, 2); }) == "delta = 0.9 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, 2, 1); }) == "epsilon = 1 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, kNan, 2); }) == "delta = nan is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, 2, -kInfinity); }) == "epsilon = -inf is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, 1000.5, 2); }) == "delta = 1000.5 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superellipsoid(axes, 1.01, 1000); }).empty());
}

TEST_CASE("radii outside the range are refused by name; 0 is a point") {
  const auto core = std::make_shared<Sphere>(1);
  for (const auto& construct : {std::function<void(double)>([](double radius) { Sphere{radius}; }),
                                std::function<void(double)>([&](double radius) { Rounded(core, radius); })}) {
    CHECK(refusal([&] { construct(-1e-3); }) == "radius = -0.001 m is outside [0, 1e+30] m");
    CHECK(refusal([&] { construct(kNan); }) == "radius = nan m is outside [0, 1e+30] m");
    CHECK(refusal([&] { construct(kInfinity); }) == "radius = inf m is outside [0, 1e+30] m");
    CHECK(refusal([&] { construct(0); }).empty());
  }
  CHECK(refusal([] { Rounded(nullptr, 1); }) == "core is null; a shape is needed");
}
