// How far a flat contact counts: the closed forms of a ramp and of a tilt.
#include "kernel/fading.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "support/relative.hpp"

using namespace granular;
using supernormal::test::relative;

TEST_CASE("lammps: a ramp is 0 up to 0, 1 from 1 on, and a cubic with level ends in between") {
  for (const double x : {-2.0, 0.0, 1.0, 7.0}) {
    CHECK(Ramp(x).value == (x > 0.5 ? 1 : 0));
    CHECK(Ramp(x).slope == 0);
  }
  CHECK(Ramp(0.5).value == 0.5);
  CHECK(Ramp(0.5).slope == 1.5);
  for (const double x : {0.1, 0.3, 0.8}) {
    CHECK(Ramp(x).value + Ramp(1 - x).value == relative(1).epsilon(1e-15));
    CHECK((Ramp(x + 1e-6).value - Ramp(x - 1e-6).value) / 2e-6 == relative(Ramp(x).slope).epsilon(1e-8));
  }
}

TEST_CASE("lammps: opposite faces count in full up to the largest tilt, half at 1.5 times, and not at all from twice on") {
  const double largest = 0.2;
  const Vector3 axis = Vector3(1, 2, -0.5).normalized(), normal2 = axis.unitOrthogonal();
  const auto tilt = [&](double angle) { return Tilt(Eigen::AngleAxisd(angle, axis) * -normal2, normal2, largest); };
  for (const auto& [angle, share] : {std::pair(0.0, 1.0), std::pair(0.199, 1.0), std::pair(0.3, 0.5), std::pair(0.401, 0.0)}) {
    CHECK(tilt(angle).share == doctest::Approx(share).epsilon(1e-14));
    CHECK(tilt(-angle).share == doctest::Approx(share).epsilon(1e-14));
    if (angle != 0.3) CHECK(tilt(angle).by_turn == Vector3::Zero());
  }
  // Faces that look the same way.
  CHECK(Tilt(normal2, normal2, largest).share == 0);
  // The derivative is along the axis of the tilt, and odd in it.
  for (const double angle : {-0.3, 0.25, 0.37}) {
    const double slope = (tilt(angle + 1e-6).share - tilt(angle - 1e-6).share) / 2e-6;
    CHECK((tilt(angle).by_turn - slope * axis).norm() < 1e-8);
  }
}
