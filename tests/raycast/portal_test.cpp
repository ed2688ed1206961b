// Tests of boundary points around a line.
#include "raycast/portal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "support/relative.hpp"

using namespace supernormal;

namespace {

// The view is down along -z. The line is the z-axis, c the origin, d = -r.
const Vector3 kDown = -Vector3::UnitZ();
constexpr double kRounding = 1e-15;

Vector3 beside(double angle, double length) { return length * Vector3(std::cos(angle), std::sin(angle), 0); }

}  // namespace

TEST_CASE("portal: points on one side leave a sector of directions that may separate") {
  Portal portal(kDown, kRounding);
  CHECK(portal.sector() == test::relative(2 * std::numbers::pi));
  portal.add(beside(0.3, 2));
  CHECK(portal.sector() == test::relative(std::numbers::pi));
  portal.add(beside(-0.4, 0.5));
  portal.add(beside(0.1, 7));  // between the two others, so it changes nothing
  CHECK_FALSE(portal.is_pierced());
  CHECK(std::isinf(portal.upper_bound()));
  CHECK(portal.sector() == test::relative(std::numbers::pi - 0.7));
  CHECK(portal.bisector().normalized().dot(beside(-0.05, 1)) == test::relative(1));
  CHECK(std::abs(portal.edge_normal().dot(beside(0.3, 2) - beside(-0.4, 0.5))) < 1e-15);
  CHECK(portal.may_separate(portal.edge_normal()));
  CHECK(portal.may_separate(beside(std::numbers::pi / 2 - 0.41, 1)));
  CHECK_FALSE(portal.may_separate(beside(std::numbers::pi / 2 - 0.39, 1)));
  CHECK_FALSE(portal.may_separate(beside(std::numbers::pi, 1)));
}

TEST_CASE("portal: three points around the line, or two on either side of it, are a portal") {
  Portal portal(kDown, kRounding);
  for (const double angle : {0.0, 2.0, 4.0}) {
    CHECK_FALSE(portal.is_pierced());
    portal.add(beside(angle, 1 + angle) - Vector3::UnitZ());  // r at z = 1
  }
  REQUIRE(portal.is_pierced());
  CHECK(portal.upper_bound() == test::relative(-1));  // along -z
  CHECK((portal.normal().normalized() - Vector3::UnitZ()).norm() < 1e-15);

  Portal segment(kDown, kRounding);
  segment.add(Vector3(1, 0, -3));
  segment.add(Vector3(-2, 0, 0));
  REQUIRE(segment.is_pierced());
  CHECK(segment.upper_bound() == test::relative(-2));
  CHECK(std::abs(segment.normal().dot(Vector3(3, 0, -3))) < 1e-15);
  CHECK(segment.normal().dot(kDown) < 0);
}

TEST_CASE("portal: a point on the line is a portal") {
  Portal portal(kDown, kRounding);
  CHECK(portal.add(Vector3(0.5 * kRounding, 0, -2)));
  REQUIRE(portal.is_pierced());
  CHECK(portal.upper_bound() >= -2);
  CHECK(portal.upper_bound() == test::relative(-2));
  CHECK((portal.normal().normalized() + kDown).norm() < 1e-15);
}

// The line passes through a vertex of the triangle or through its middle. The bound includes the rounding of the points.
TEST_CASE("portal: the bound holds for steep portals of rounded points") {
  constexpr double kCoarse = 1e-9;
  std::mt19937_64 engine(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  int pierced = 0;
  for (int k = 0; k < 3000; ++k) {
    CAPTURE(k);
    const double steepness = std::pow(10, 3 * uniform(engine));
    const double turn = 2 * std::numbers::pi * uniform(engine);
    const Vector3 shift = k % 2 == 0 ? beside(turn, 1) : Vector3(Vector3::Zero());
    Portal portal(kDown, kCoarse);
    for (int i = 0; i < 3; ++i) {
      const Vector3 p = beside(turn + std::numbers::pi + 2.1 * i, 1) + shift;
      const Vector3 off{uniform(engine) - 0.5, uniform(engine) - 0.5, uniform(engine) - 0.5};
      portal.add(Vector3(p.x(), p.y(), steepness * p.x()) + kCoarse * off.normalized());
    }
    if (!portal.is_pierced()) continue;
    ++pierced;
    CHECK(portal.upper_bound() >= 0);
    CHECK(portal.upper_bound() <= 3 * (1 + steepness) * kCoarse);
  }
  CHECK(pierced > 2000);
}

TEST_CASE("portal: each point in front of the portal raises it, and the bound holds") {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> gauss;
  for (int k = 0; k < 200; ++k) {
    Portal portal(kDown, kRounding);
    double highest = -std::numeric_limits<double>::infinity();  // height of the portal so far
    for (int i = 0; i < 60; ++i) {
      const Vector3 r = Vector3{gauss(engine), gauss(engine), gauss(engine)}.normalized();  // on the unit sphere
      portal.add(-r);
      if (!portal.is_pierced()) continue;
      const double height = -portal.upper_bound();
      CHECK(height >= highest);
      CHECK(height <= 1);
      highest = height;
      const Vector3 n = portal.normal().normalized();
      CHECK(std::abs(portal.support_bound(n) + n.z() * height) < 1e-12);
    }
    CHECK(portal.is_pierced());
    CHECK(highest > 0);
  }
}
