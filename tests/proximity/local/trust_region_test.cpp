// The maximum of a quadratic model in a disc, against sampling.
#include "proximity/local/trust_region.hpp"

#include <doctest/doctest.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "support/draw.hpp"

using namespace supernormal;

namespace {

/// The largest gain in the disc: at the stationary point if that is a maximum inside, or on the circle.
double largest_sampled(const QuadraticModel& model, double radius) {
  const int spokes = draws(20000);
  double largest = 0;
  for (int spoke = 0; spoke < spokes; ++spoke) {
    const double angle = 2 * std::numbers::pi * spoke / spokes;
    const Vector2 direction(std::cos(angle), std::sin(angle));
    largest = std::max(largest, model.gain(radius * direction));
    // Along a ray: the vertex of the parabola if it lies inside.
    const double bend = direction.dot(model.A * direction);
    const double slope = model.g.dot(direction);
    if (bend > 0 && slope > 0 && slope / bend < radius) largest = std::max(largest, 0.5 * slope * (slope / bend));
  }
  return largest;
}

Symmetric2 with_eigenvalues(double low, double high, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {high * c * c + low * s * s, (high - low) * c * s, high * s * s + low * c * c};
}

/// A step to the circle is only a trial: the solver lets it miss the circle by a hundredth.
constexpr double kShare = 0.97;

void check(const QuadraticModel& model, double radius) {
  const Vector2 u = model.maximize(radius);
  const double largest = largest_sampled(model, radius);
  CHECK(u.allFinite());
  CHECK(u.norm() <= radius * (1 + 1e-2));
  const double gain = model.gain(u);
  if (!(gain >= kShare * largest - 1e-15)) {
    FAIL_CHECK("g ", model.g.x(), " ", model.g.y(), " A ", model.A.xx, " ", model.A.xy, " ", model.A.yy, " radius ", radius,
               " gain ", gain, " of ", largest);
  }
}

}  // namespace

TEST_CASE("random models: definite, indefinite and negative") {
  std::mt19937_64 engine(61);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < draws(300); ++trial) {
    const QuadraticModel model{{gauss(engine), gauss(engine)}, {2 * gauss(engine), gauss(engine), 2 * gauss(engine)}};
    for (const double radius : {1e-3, 0.3, 1.0, 4.0}) check(model, radius);
  }
}

TEST_CASE("the Newton step where it fits") {
  const QuadraticModel model{{0.3, -0.2}, {2, 0.5, 1}};
  const Vector2 u = model.maximize(1);
  CHECK((model.A * u - model.g).norm() <= 1e-15);
  CHECK(std::abs(model.gain(u) - model.largest_gain()) <= 1e-16);
}

TEST_CASE("the hard case: no slope along the negative curvature") {
  for (const double low : {-1e-6, -1.0, -1e3}) {
    for (const double slope : {0.0, 1e-300, 1e-17, 1e-9, 0.1, 10.0}) {
      for (const double angle : {0.0, 0.3, 1.2}) {
        for (const double noise : {0.0, 1e-300, -1e-20, 1e-17}) {
          const Symmetric2 A = with_eigenvalues(low, 1.25, angle);
          const Vector2 up(std::cos(angle), std::sin(angle)), across(-up.y(), up.x());
          for (const double radius : {1e-6, 1e-2, 1.0}) check({slope * up + noise * across, A}, radius);
        }
      }
    }
  }
}

TEST_CASE("both curvatures negative and equal") {
  for (const Vector2& g : {Vector2(0, 0), Vector2(1e-17, 0), Vector2(1e-300, 1e-300), Vector2(0.1, -0.4)}) {
    for (const double radius : {1e-8, 1.0, 4.0}) check(QuadraticModel{g, {-1.25, 0, -1.25}}, radius);
  }
}

TEST_CASE("nothing to gain: no step") {
  CHECK(QuadraticModel{{0, 0}, {1, 0, 2}}.maximize(1) == Vector2::Zero());
  CHECK(QuadraticModel{{0, 0}, {1, 0, 2}}.largest_gain() == 0);
}

TEST_CASE("the largest gain is infinite where some way leads up for ever") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CHECK(QuadraticModel{{0.1, 0}, {1, 0, -1e-9}}.largest_gain() == kInfinity);
  CHECK(QuadraticModel{{0.1, 0}, {1, 0, 0}}.largest_gain() == kInfinity);
  CHECK(QuadraticModel{{0.1, 0}, {1, 0, 1e-9}}.largest_gain() < 1);
}

TEST_CASE("one radius of curvature beyond all measure leaves the other its digits") {
  for (const double huge : {1e20, 1e60, 1e120}) {
    const QuadraticModel model{{0.3, 0.2}, {huge, 0, 2}};
    std::feclearexcept(FE_ALL_EXCEPT);
    const Vector2 u = model.maximize(1);
    CHECK(std::abs(u.y() - 0.1) <= 1e-15);
    CHECK(std::abs(u.x()) <= 0.3 / huge * (1 + 1e-12));
    CHECK(std::abs(model.largest_gain() - 0.01) <= 1e-15);
    const Eigen2 e(model.A);
    CHECK(e.low == 2);
    CHECK(e.high == huge);
    // And with the circle in the way.
    const Vector2 rim = model.maximize(0.01);
    CHECK(std::abs(rim.y() - 0.01) <= 1e-4);
    CHECK(std::abs(rim.x()) <= 1e-10);
    CHECK(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == 0);
  }
}

TEST_CASE("one curvature is next to nothing, the other that over again: no overflow on the way to the circle") {
  const QuadraticModel model{{1.2706869609825529e-225, 0},
                             {8.8208958574947383e-211, 1.7849350496270764e-239, 3.6118702486213016e-268}};
  std::feclearexcept(FE_ALL_EXCEPT);
  const Vector2 u = model.maximize(1);
  CHECK(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == 0);
  CHECK(u.norm() <= 1 + 1e-15);
  CHECK(model.gain(u) >= 0);
}

TEST_CASE("a denormal slope without curvature is none") {
  std::feclearexcept(FE_ALL_EXCEPT);
  CHECK(QuadraticModel{{1e-312, 0}, {0, 0, 0}}.maximize(1) == Vector2::Zero());
  CHECK(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == 0);
}

TEST_CASE("a denormal slope without curvature beside one with next to none: the latter's step") {
  const QuadraticModel model{{-3.6357697429871883e-283, -3.3005054434138124e-314}, {1.9871563776991301e-165, 0, 0}};
  std::feclearexcept(FE_ALL_EXCEPT);
  const Vector2 u = model.maximize(1);
  CHECK(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == 0);
  CHECK(u.x() == model.g.x() / model.A.xx);
  CHECK(u.y() == 0);
}

TEST_CASE("level one way, and next to no slope the other way: the step is the one there") {
  std::feclearexcept(FE_ALL_EXCEPT);
  CHECK(QuadraticModel{{0, 1e-196}, {0, 0, 2e-20}}.maximize(1) == Vector2(0, 1e-196 / 2e-20));
  CHECK(QuadraticModel{{1e-196, 0}, {2e-20, 0, 0}}.maximize(1) == Vector2(1e-196 / 2e-20, 0));
  CHECK(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == 0);
}

TEST_CASE("eigenvalues and vectors") {
  std::mt19937_64 engine(62);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 1000; ++trial) {
    const Symmetric2 A{gauss(engine), gauss(engine), gauss(engine)};
    const Eigen2 e(A);
    CHECK(e.low <= e.high);
    CHECK((A * e.low_vector - e.low * e.low_vector).norm() <= 4e-15);
    CHECK((A * e.high_vector - e.high * e.high_vector).norm() <= 4e-15);
    CHECK(std::abs(e.low_vector.dot(e.high_vector)) <= 1e-15);
    CHECK(std::abs(e.high_vector.norm() - 1) <= 1e-15);
    const Vector2 b(gauss(engine), gauss(engine));
    CHECK((A * A.solve(b) - b).norm() <= 1e-11 * (1 + A.solve(b).norm()));
  }
  const Eigen2 zero(Symmetric2{});
  CHECK(zero.low == 0);
  CHECK(zero.high == 0);
  CHECK(zero.high_vector.norm() == 1);
}

TEST_CASE("solved whatever the sizes of the radii, or singular") {
  const auto check = [](const Symmetric2& A, const Vector2& x) {
    const Vector2 solved = A.solve(A * x);
    CHECK((solved - x).cwiseAbs().cwiseQuotient(x.cwiseAbs()).maxCoeff() <= 1e-12);
  };
  check({1e25, 0, 1e-273}, {1e-25, 1});
  check({1e-273, 0, 1e25}, {1, 1e-25});
  check({1e120, 1e-60, 1e-150}, {1e-60, 1e40});
  check({1e-20, 3, -1e-30}, {2, -1});
  check({0, 1, 0}, {2, -1});
  CHECK(Symmetric2{1e25, 0, 1e-273}.solve({0.4, 0}) == Vector2(0.4 / 1e25, 0));
  for (const Symmetric2& singular : {Symmetric2{0, 0, 0}, Symmetric2{1, 0, 0}, Symmetric2{0, 0, 1}, Symmetric2{1, 1, 1}}) {
    CHECK_FALSE(singular.solve({1, 2}).allFinite());
  }
}
