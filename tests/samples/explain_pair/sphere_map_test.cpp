// Tests that the maps of the sphere have inverses and preserve areas.
#include "method/sphere_map.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

using namespace explain_pair;

namespace {

/// A frame other than the world's.
Frame tilted_frame() {
  const Eigen::Matrix3d R = Eigen::Quaterniond(0.5, 0.1, -0.7, 0.5).normalized().toRotationMatrix();
  return {R.col(0), R.col(1), R.col(2)};
}

Vector3 random_normal(std::mt19937_64& engine) {
  std::normal_distribution<double> gauss;
  return Vector3(gauss(engine), gauss(engine), gauss(engine)).normalized();
}

}  // namespace

TEST_CASE("sphere map: Hammer's map has its inverse") {
  std::mt19937_64 engine(1);
  const Frame frame = tilted_frame();
  double farthest = 0;
  for (int k = 0; k < 10000; ++k) {
    const Vector3 n = random_normal(engine);
    const Vector3 back = normal_at(frame, HammerMap::to_sphere(HammerMap::to_plane(place_of(frame, n))));
    farthest = std::max(farthest, (back - n).norm());
  }
  // Near the rim, where the map folds, half of the digits are lost.
  CHECK(farthest < 1e-7);
}

TEST_CASE("sphere map: Lambert's map has its inverse up to the antipode") {
  std::mt19937_64 engine(2);
  const Frame frame = tilted_frame();
  double farthest = 0;
  for (int k = 0; k < 10000; ++k) {
    const Vector3 n = random_normal(engine);
    farthest = std::max(farthest, (LambertMap::to_sphere(frame, LambertMap::to_plane(frame, n)) - n).norm());
  }
  CHECK(farthest < 1e-12);
  CHECK(LambertMap::to_plane(frame, -frame.right).norm() == doctest::Approx(2));
  const Vector3 near = (frame.right + 1e-9 * frame.up).normalized();
  CHECK(LambertMap::to_plane(frame, near).y() == doctest::Approx(1e-9));
}

TEST_CASE("sphere map: both maps preserve areas") {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> longitude(-0.95 * std::numbers::pi, 0.95 * std::numbers::pi),
      latitude(-0.45 * std::numbers::pi, 0.45 * std::numbers::pi);
  const Frame frame = tilted_frame();
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 1000; ++k) {
    const Place place{longitude(engine), latitude(engine)};
    const auto area_of = [&](const auto& map) {
      Eigen::Matrix2d slopes;
      slopes.col(0) = map({place.longitude + kStep, place.latitude}) - map({place.longitude - kStep, place.latitude});
      slopes.col(1) = map({place.longitude, place.latitude + kStep}) - map({place.longitude, place.latitude - kStep});
      return slopes.determinant() / (4 * kStep * kStep) / std::cos(place.latitude);
    };
    CHECK(area_of([](const Place& p) { return HammerMap::to_plane(p); }) == doctest::Approx(1).epsilon(1e-5));
    CHECK(area_of([&](const Place& p) { return LambertMap::to_plane(frame, normal_at(frame, p)); }) ==
          doctest::Approx(1).epsilon(1e-5));
  }
  CHECK(std::numbers::pi * HammerMap::kHalfWidth * HammerMap::kHalfHeight == doctest::Approx(4 * std::numbers::pi));
}

TEST_CASE("sphere map: the centre, north and east are in their places") {
  const Frame frame = tilted_frame();
  CHECK(HammerMap::to_plane(place_of(frame, frame.right)).norm() < 1e-12);
  CHECK(HammerMap::to_plane(place_of(frame, frame.up)).y() == doctest::Approx(HammerMap::kHalfHeight));
  CHECK(HammerMap::to_plane(place_of(frame, -frame.toward)).x() > 1);
  CHECK(LambertMap::to_plane(frame, (frame.right - 0.1 * frame.toward).normalized()).x() > 0);
}
