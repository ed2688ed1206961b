#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "model/fit_body.hpp"
#include "model/fit_union.hpp"
#include "output/report.hpp"
#include "study/truth.hpp"

using namespace fit;

namespace {

Body make_body(Family family, double delta, double epsilon, double taper = 0) {
  return {family, {3, -2, 5}, Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized(), {1.5, 1.1, 0.8}, delta, epsilon, taper};
}

double largest_deviation(const Body& fitted, const Body& truth) {
  Eigen::Matrix3d axes;
  return deviation(aligned(fitted, truth, axes), truth).cwiseAbs().maxCoeff();
}

/// 1000 points with a noise of 1 % of a body with these exponents.
Cloud noisy_cloud(double delta, double epsilon) {
  const Body truth{
      Family::Superellipsoid, {3, -2, 5}, Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized(), {1.5, 1.4, 0.8}, delta, epsilon, 0};
  return scatter(truth, {.points = 1000, .noise = 0.01});
}

}  // namespace

TEST_CASE("bodies without noise are recovered") {
  for (const Body& truth : {make_body(Family::Ellipsoid, 2, 2), make_body(Family::Superellipsoid, 1.2, 1.2),
                            make_body(Family::Superellipsoid, 2.5, 4), make_body(Family::Superellipsoid, 8, 1.5),
                            make_body(Family::Superellipsoid, 20, 20), make_body(Family::Superovoid, 3, 2.5, -0.4)}) {
    CAPTURE(truth.delta);
    CAPTURE(truth.epsilon);
    const FittedBody fitted = fit_body(scatter(truth, {.points = 1000}), {.family = truth.family});
    CHECK(largest_deviation(fitted.body, truth) < 1e-6);
    CHECK(fitted.uncertainty.sigma < 1e-9);
    CHECK(fitted.outliers.empty());
  }
}

TEST_CASE("the fit selects the family that the data need") {
  for (const Body& truth :
       {make_body(Family::Ellipsoid, 2, 2), make_body(Family::Superellipsoid, 2.5, 4), make_body(Family::Superovoid, 2, 2, -0.4)}) {
    const FittedBody fitted = fit_body(scatter(truth, {.points = 1000, .noise = 0.01}));
    CHECK(fitted.body.family == truth.family);
  }
}

TEST_CASE("half of a body's surface is enough, with and without normals") {
  const Body truth = make_body(Family::Superellipsoid, 2.5, 4);
  for (const bool has_normals : {false, true}) {
    const Cloud exact = scatter(truth, {.points = 1000, .is_half_missing = true, .has_normals = has_normals});
    CHECK(largest_deviation(fit_body(exact, {.family = truth.family}).body, truth) < 1e-6);
    const Cloud noisy = scatter(truth, {.points = 1000, .noise = 0.05, .is_half_missing = true, .has_normals = has_normals});
    const FittedBody fitted = fit_body(noisy, {.family = truth.family});
    CHECK(fitted.body.half_axes.maxCoeff() < 1.5 + 4 * fitted.uncertainty.standard_error.segment<3>(kLogAxes).maxCoeff());
    CHECK(fitted.body.half_axes.maxCoeff() < 2);
  }
}

TEST_CASE("a motion or a change of units of the data transforms the answer and changes nothing else") {
  const Body truth = make_body(Family::Superellipsoid, 3, 2.2);
  const Cloud cloud = scatter(truth, {.points = 1000, .noise = 0.01});
  const FittedBody first = fit_body(cloud, {.family = truth.family});
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.2, -0.6, 0.5, 0.4).normalized();
  const Vector3 shift(-7, 40, 2);
  const double scale = 1e-3;
  Cloud other = cloud;
  for (Vector3& x : other.points) x = scale * (turn * x) + shift;
  const FittedBody second = fit_body(other, {.family = truth.family});
  Body expected = first.body;
  expected.position = scale * (turn * expected.position) + shift;
  expected.orientation = turn * expected.orientation;
  expected.half_axes *= scale;
  Eigen::Matrix3d axes;
  const Body found = aligned(second.body, expected, axes);
  const auto difference = deviation(found, expected);
  CHECK(difference.segment<3>(kLogAxes).cwiseAbs().maxCoeff() < 1e-5 * scale);
  CHECK(difference.segment<3>(kPosition).cwiseAbs().maxCoeff() < 1e-5 * scale);
  CHECK(difference.segment<3>(kRotation).cwiseAbs().maxCoeff() < 1e-5);
  CHECK(std::abs(difference[kLogDelta]) < 1e-4);
  CHECK(std::abs(difference[kLogEpsilon]) < 1e-4);
  CHECK(second.uncertainty.sigma / first.uncertainty.sigma == doctest::Approx(scale).epsilon(1e-4));
}

TEST_CASE("outliers are removed") {
  const Body truth = make_body(Family::Superellipsoid, 2.5, 4);
  Cloud cloud = scatter(truth, {.points = 1000, .noise = 0.005});
  for (int i = 0; i < 50; ++i)
    cloud.points.emplace_back(truth.position + Vector3(std::cos(i), std::sin(2 * i), std::cos(3 * i)) * 2.2);
  const FittedBody fitted = fit_body(cloud, {.family = truth.family});
  CHECK(fitted.outliers.size() >= 40);
  CHECK(largest_deviation(fitted.body, truth) < 0.1);
  Eigen::Matrix3d axes;
  const auto difference = deviation(aligned(fitted.body, truth, axes), truth);
  CHECK(difference.segment<3>(kLogAxes).cwiseAbs().maxCoeff() < 5e-3);
}

TEST_CASE("gross outliers affect neither the search nor the extent") {
  const Body truth = make_body(Family::Superellipsoid, 4, 4);
  for (const std::size_t points : {40, 300, 1000}) {
    const Cloud clean = scatter(truth, {.points = points, .noise = 0.005});
    const FittedBody expected = fit_body(clean);
    for (const double radii : {10.0, 1e6}) {
      Cloud cloud = clean;
      std::vector<std::size_t> outliers;
      for (int i = 0; i < 5; ++i) {
        outliers.push_back(cloud.points.size());
        const Vector3 way(std::cos(i), std::sin(2 * i), std::cos(3 * i + 1));
        cloud.points.emplace_back(truth.position + radii * (i == 4 ? Vector3(Vector3::UnitX()) : Vector3(way.normalized())));
      }
      const FittedBody fitted = fit_body(cloud);
      CAPTURE(points);
      CAPTURE(radii);
      CHECK(fitted.outliers == outliers);
      CHECK(fitted.inliers == points);
      CHECK(largest_deviation(fitted.body, expected.body) < 1e-9);
      CHECK(describe_outliers(std::vector{fitted}, cloud).find("point " + std::to_string(points + 5) + " at (") !=
            std::string::npos);
    }
  }
}

TEST_CASE("points are removed only beyond an empty shell") {
  // The ends of a needle, half of a body and a second group with a fifth of the points are no outliers.
  Body needle = make_body(Family::Ellipsoid, 2, 2);
  needle.half_axes = {50, 1, 1};
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const std::vector<Vector3> points = scatter(needle, {.points = 30, .seed = seed}).points;
    CHECK(cut_off(points, points.size() / 5).empty());
  }
  const Cloud half = scatter(make_body(Family::Superellipsoid, 2.5, 4), {.points = 30, .is_half_missing = true});
  CHECK(cut_off(half.points, half.points.size() / 5).empty());
  std::vector<Vector3> groups = half.points;
  for (const Vector3& x : half.points) groups.emplace_back(x + Vector3(100, 0, 0));
  CHECK(cut_off(groups, groups.size() / 5).empty());
  groups.resize(34);
  CHECK(cut_off(groups, 4) == std::vector<std::size_t>{30, 31, 32, 33});
  CHECK(cut_off(groups, 3).empty());
}

TEST_CASE("parameters that the data do not determine are reported") {
  // A body of revolution may be rotated about its axis.
  Body truth = make_body(Family::Ellipsoid, 2, 2);
  truth.half_axes = {1.5, 0.8, 0.8};
  for (const double noise : {0.0, 0.01}) {
    const FittedBody fitted = fit_body(scatter(truth, {.points = 1000, .noise = noise}), {.family = Family::Ellipsoid});
    CHECK_FALSE(fitted.uncertainty.is_determined[kRotation]);
    CHECK(fitted.uncertainty.is_determined[kRotation + 1]);
    CHECK(fitted.uncertainty.is_determined[kRotation + 2]);
    CHECK(fitted.uncertainty.is_determined[kLogAxes]);
  }
}

TEST_CASE("standard errors agree with the spread of repeated fits") {
  const Body truth = make_body(Family::Superellipsoid, 2.5, 4);
  Gradient square = Gradient::Zero(), expected = Gradient::Zero();
  constexpr int kFits = 40;
  for (int k = 0; k < kFits; ++k) {
    const Cloud cloud = scatter(truth, {.points = 400, .noise = 0.01, .seed = static_cast<std::uint64_t>(k) + 1});
    const FittedBody fitted = refine_body(truth, cloud);
    square += deviation(fitted.body, truth).cwiseAbs2() / kFits;
    expected += fitted.uncertainty.standard_error.cwiseAbs2() / kFits;
  }
  for (int i = 0; i < kTaper; ++i) {
    CAPTURE(i);
    // The mean of 40 squares is outside a factor of 2 of its expectation once in 10^4.
    CHECK(square[i] / expected[i] > 0.45);
    CHECK(square[i] / expected[i] < 2.1);
  }
}

TEST_CASE("useless data are refused") {
  const Cloud whole = scatter(make_body(Family::Ellipsoid, 2, 2), {.points = 300});
  CHECK_THROWS_WITH_AS(fit_body({}), "0 points; a fit takes at least 10", std::invalid_argument);
  CHECK_THROWS_WITH_AS(fit_body(thinned(whole, 11), {.family = Family::Superellipsoid}), "11 points; a fit takes at least 12",
                       std::invalid_argument);
  Cloud bad = whole;
  bad.points[7].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(fit_body(bad), "a coordinate is not finite", std::invalid_argument);
  Cloud same = whole;
  for (Vector3& x : same.points) x = Vector3(1, 2, 3);
  CHECK_THROWS_WITH_AS(fit_body(same), "the points are all in one place, to the rounding of their coordinates",
                       std::invalid_argument);
  Cloud tiny = whole;
  for (Vector3& x : tiny.points) x *= 1e-300;
  CHECK_THROWS_WITH_AS(fit_body(tiny), doctest::Contains("allowed: 1e-25 to 1e+25. Is the unit right (--unit)?"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(fit_union(whole, 17), "at most 17 bodies; allowed: 1 to 16", std::invalid_argument);
}

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
