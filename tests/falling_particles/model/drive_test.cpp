// Tests of the laws of drives, and of walls that face each other.
#include "common/drive.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "model/wall.hpp"
#include "support/relative.hpp"

using namespace falling_particles;
using supernormal::test::relative;

TEST_CASE("a power adds power times step to the energy in each step, up to its limit at rest") {
  constexpr double kMass = 0.5, kLargest = 100;
  Drive drive{Vector3::UnitX(), kLargest, kMass};
  drive.power = 3;
  for (const double step : {1e-4, 1e-2}) {
    CAPTURE(step);
    CHECK(push_of(drive, 0, 1e-9) == kLargest);
    CHECK(push_of(drive, -2, step) == kLargest);
    for (const double speed : {0.1, 2.0}) {
      const double then = speed + step / kMass * push_of(drive, speed, step);
      CHECK(kMass / 2 * (then * then - speed * speed) == relative(drive.power * step).epsilon(1e-12));
    }
  }
  CHECK(push_of(drive, 2, 1e-9) == relative(drive.power / 2).epsilon(1e-6));
  drive.power = 0;
  CHECK(push_of(drive, 2, 0.1) == kLargest);
}

TEST_CASE("the distance of walls that face each other is that of their nearest parallel faces, however they overlap elsewhere") {
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.3, Vector3(1, 2, 3).normalized()));
  const auto at = [&](double x, double y, double z) { return WallPose{turned * Vector3(x, y, z), turned}; };
  const BoxShape wide{{0.1, 2, 2}}, thin{{0.2, 3, 1}};
  const PlaneShape plane{0, -Vector3::UnitX()};
  const auto boxes = facing_faces(wide, at(0, 0, 0), thin, at(0.7, 0.5, -0.2));
  REQUIRE(boxes);
  CHECK(boxes->distance() == relative(0.7 - 0.05 - 0.1).epsilon(1e-12));
  CHECK((boxes->normal - turned * Vector3::UnitX()).norm() < 1e-15);
  CHECK(boxes->first == relative(0.05).epsilon(1e-12));
  const auto with_plane = facing_faces(plane, at(0.4, 5, 5), wide, at(0, 0, 0));
  REQUIRE(with_plane);
  CHECK(with_plane->distance() == relative(0.35).epsilon(1e-12));
  CHECK(with_plane->second == relative(-0.05).epsilon(1e-12));
  CHECK(facing_faces(wide, at(0, 0, 0), wide, at(0.08, 0, 0))->distance() < 0);
  CHECK_FALSE(facing_faces(plane, at(0, 0, 0), plane, at(1, 0, 0)));
  CHECK_FALSE(facing_faces(wide, at(0, 0, 0), wide, {Vector3(0.7, 0, 0), Eigen::Quaterniond::Identity()}));
  CHECK_FALSE(facing_faces(wide, at(0, 0, 0), CylinderShape{1, 1}, at(3, 0, 0)));
}
