// Tests of the tapers that are refused: the condition that fails is named, and it is the exact limit of convexity.
#include "shapes/superovoid_convexity.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "supernormal/shapes/superovoid.hpp"
#include "support/draw.hpp"
#include "support/refusal.hpp"
#include "support/relative.hpp"

using namespace supernormal;
using namespace supernormal::test;

TEST_CASE("superovoid: what is not convex is refused, with the condition that fails") {
  const Vector3 axes(3, 2, 1);
  CHECK(Superovoid::max_taper(2) == test::relative(std::numbers::sqrt2 / 2).epsilon(1e-15));
  CHECK(refusal([&] { Superovoid(axes, 2, 4, 0.9, 0.5); }) ==
        "taper_x = 0.9 is outside [-0.8919053362520408, 0.8919053362520408], where a body with epsilon = 4 is convex: |taper| <= "
        "2^(1/epsilon) (epsilon - 1)/epsilon");
  CHECK(refusal([&] { Superovoid(axes, 2, 2, 0, std::numeric_limits<double>::quiet_NaN()); }).find("taper_y = nan is outside") ==
        0);
  CHECK(refusal([&] { Superovoid(axes, 2, 2.5, 0.1, 0.2); }) ==
        "taper_x = 0.1 and taper_y = 0.2 differ, but with epsilon = 2.5 a body is convex only if they are equal: above 2 it has "
        "straight sides, which different tapers twist");
  CHECK(refusal([&] { Superovoid(axes, 1.1, 2, 0.5, -0.5); })
            .find("taper_x = 0.5 and taper_y = -0.5 with delta = 1.1 and epsilon = 2: not convex, because the width of the section "
                  "in some direction is not a concave function of z at z = ") == 0);
  CHECK(refusal([&] { Superovoid(axes, 2, 2, 0.5, -0.5); }).empty());
  CHECK(refusal([&] { Superovoid(axes, 0.9, 2, 0, 0); }) == "delta = 0.9 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superovoid(axes, 2, 1001, 0, 0); }) == "epsilon = 1001 is outside [1.01, 1000]");
  CHECK(refusal([&] { Superovoid(Vector3(1, 0, 1), 2, 2, 0, 0); }) == "half-axis b = 0 m is outside [1e-30, 1e+30] m");
  // The closed form in the header: k^2 <= delta - 1 for tapers -k and k with epsilon = 2.
  CHECK(refusal([&] { Superovoid(axes, 1.25, 2, -0.499999, 0.499999); }).empty());
  CHECK_FALSE(refusal([&] { Superovoid(axes, 1.25, 2, -0.500001, 0.500001); }).empty());
}

TEST_CASE("superovoid: the limit of convexity is exact: chords of the surface, scanned") {
  // The width g(s) of the section in a direction (A, B) is concave: no midpoint of a chord lies above it. Exponents, tapers and
  // directions are random; the least second difference tells on which side of the limit a body is.
  std::mt19937_64 engine(13);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int convex = 0, refused = 0;
  for (int i = 0; i < draws(400); ++i) {
    const double delta = 1.05 + 4 * std::abs(uniform(engine)) * (i % 2 == 0 ? 1 : 0.02);
    const double epsilon = i % 4 == 3 ? 2.05 + 4 * std::abs(uniform(engine)) : 1.1 + 0.9 * std::abs(uniform(engine));
    const double x = 1.1 * uniform(engine), y = i % 4 >= 2 ? x : 1.1 * uniform(engine);
    const double p = delta / (delta - 1);
    double least = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 4000; ++trial) {
      const double s = 0.999 * uniform(engine), step = 1e-3 * (1 - std::abs(s));
      if (x == y && std::abs(s) < 0.1) continue;  // a straight side, where only rounding is left
      const double share = std::abs(uniform(engine));
      if (std::min(1 + x * s, 1 + y * s) <= 0.01) {
        least = -1;
        break;
      }
      const auto width = [&](double height) {
        const double inside =
            std::pow(share * (1 + x * height) / (1 + x * s), p) + std::pow((1 - share) * (1 + y * height) / (1 + y * s), p);
        return std::pow(1 - std::pow(std::abs(height), epsilon), 1 / epsilon) * std::pow(inside, 1 / p);
      };
      const double room = 1 - std::pow(std::abs(s), epsilon);
      const double second = (2 * width(s) - width(s + step) - width(s - step)) / (step * step) / width(s);
      least = std::min(least, second * room * room * std::pow(std::abs(s), 2 - epsilon) / (epsilon - 1));
    }
    const bool accepted = refusal([&] { Superovoid(Vector3(3, 2, 1), delta, epsilon, x, y); }).empty();
    (accepted ? convex : refused) += 1;
    // The scan is coarse: within 5 % of the limit it proves nothing.
    if (least < -0.05) CHECK_MESSAGE(!accepted, "delta ", delta, " epsilon ", epsilon, " tapers ", x, " ", y, " least ", least);
    if (least > 0.05) CHECK_MESSAGE(accepted, "delta ", delta, " epsilon ", epsilon, " tapers ", x, " ", y, " least ", least);
  }
  CHECK(convex > draws(50));
  CHECK(refused > 50);
}
