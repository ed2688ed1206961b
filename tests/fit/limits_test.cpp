#include <doctest/doctest.h>

#include "model/fit_body.hpp"
#include "output/report.hpp"
#include "study/truth.hpp"

using namespace fit;

namespace {

/// 1000 points with a noise of 1 % of a body with these exponents.
Cloud noisy_cloud(double delta, double epsilon) {
  const Body truth{
      Family::Superellipsoid, {3, -2, 5}, Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized(), {1.5, 1.4, 0.8}, delta, epsilon, 0};
  return scatter(truth, {.points = 1000, .noise = 0.01});
}

}  // namespace

TEST_CASE("a fixed exponent keeps its value and has no error") {
  const FittedBody fitted =
      fit_body(noisy_cloud(2.2, 2.5), {.family = Family::Superellipsoid, .limits = {.delta = {}, .epsilon = 3.0}});
  CHECK(fitted.body.epsilon == doctest::Approx(3).epsilon(1e-12));
  CHECK(fitted.body.delta != doctest::Approx(2).epsilon(1e-3));
  CHECK(fitted.uncertainty.is_fixed[kLogEpsilon]);
  CHECK_FALSE(fitted.uncertainty.is_fixed[kLogDelta]);
  CHECK(fitted.uncertainty.standard_error[kLogEpsilon] == 0);
  CHECK(fitted.uncertainty.standard_error[kLogDelta] > 0);
  CHECK(describe(fitted).find("3   fixed\n") != std::string::npos);
}

TEST_CASE("no exponent exceeds the largest one") {
  const FittedBody fitted =
      fit_body(noisy_cloud(12, 9), {.family = Family::Superellipsoid, .limits = {.max_exponent = 6, .delta = {}, .epsilon = {}}});
  CHECK(fitted.body.delta <= 6);
  CHECK(fitted.body.epsilon <= 6);
  CHECK(std::max(fitted.body.delta, fitted.body.epsilon) > 5.9);
}

TEST_CASE("a round section has one half-axis, with one error") {
  const FittedBody fitted = fit_body(
      noisy_cloud(2, 3), {.family = Family::Superellipsoid, .limits = {.delta = {}, .epsilon = {}, .has_round_section = true}});
  CHECK(fitted.body.half_axes.x() == fitted.body.half_axes.y());
  CHECK(fitted.body.delta == doctest::Approx(2).epsilon(1e-12));
  CHECK(fitted.body.half_axes.x() > 1.3);  // between 1.4 and 1.5
  CHECK(fitted.body.half_axes.x() < 1.6);
  CHECK_FALSE(fitted.uncertainty.is_determined[kRotation + 2]);
  CHECK(fitted.uncertainty.is_determined[kLogAxes]);
}
