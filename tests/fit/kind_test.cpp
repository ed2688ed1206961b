#include "output/kind.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

using namespace fit;

namespace {

/// A box with these half-axes, density 1.
Solid box(const Vector3& a) {
  const Vector3 squares = a.cwiseAbs2();
  return {8 * a.prod(), Vector3::Zero(), 8 * a.prod() / 3 * Matrix3((squares.sum() - squares.array()).matrix().asDiagonal())};
}

/// An ellipsoid with half-axes of 3, 2 and 1 mm, or a multiple.
Specimen ellipsoid(double scale) {
  Specimen specimen;
  const Vector3 a = 1e-3 * scale * Vector3(3, 2, 1), squares = a.cwiseAbs2();
  FittedBody fitted;
  fitted.body.half_axes = a;
  fitted.body.orientation = Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized();
  specimen.name = "ellipsoid";
  specimen.fitted = {fitted};
  const double volume = 4 * std::numbers::pi / 3 * a.prod();
  specimen.solid = {volume, Vector3::Zero(), volume / 5 * Matrix3((squares.sum() - squares.array()).matrix().asDiagonal())};
  return specimen;
}

}  // namespace

TEST_CASE("the proportions of a box and of an ellipsoid follow from their moments") {
  const Proportions of_box = proportions_of(box({1, 3, 2}));
  CHECK(of_box.elongation == doctest::Approx(2.0 / 3));
  CHECK(of_box.flatness == doctest::Approx(0.5));
  CHECK(of_box.fullness == doctest::Approx(6 / std::numbers::pi / std::pow(5.0 / 3, 1.5)));
  const Proportions of_ellipsoid = proportions_of(ellipsoid(2).solid);
  CHECK(of_ellipsoid.elongation == doctest::Approx(2.0 / 3));
  CHECK(of_ellipsoid.flatness == doctest::Approx(0.5));
  CHECK(of_ellipsoid.fullness == doctest::Approx(1));
}

TEST_CASE("three grains, each twice as large as the last, spread by a factor of two about the middle one") {
  const std::vector<Specimen> specimens = {ellipsoid(1), ellipsoid(2), ellipsoid(4)};
  const std::string lines = scene_lines(specimens, "pebble");
  CHECK(lines.find("name = \"pebble\"\n") != std::string::npos);
  CHECK(lines.find("size = { distribution = \"lognormal\", median = 8.000000e-03, geometric_deviation = 2.000000, "
                   "smallest = 4.000000e-03, largest = 1.600000e-02 }\n") != std::string::npos);
  CHECK(describe(specimens).find("standard deviation") != std::string::npos);
}

TEST_CASE("grains of one size have no distribution") {
  CHECK(scene_lines(std::vector{ellipsoid(1), ellipsoid(1)}, "pebble").find("size") == std::string::npos);
}

TEST_CASE("the specimen with the middle proportions stands for its kind") {
  std::vector<Specimen> specimens = {ellipsoid(1), ellipsoid(1), ellipsoid(1)};
  specimens[0].solid = box({3, 3, 1});
  specimens[1].solid = box({3, 2, 1});
  specimens[2].solid = box({3, 1.5, 1});
  CHECK(typical_of(specimens) == 1);
}
