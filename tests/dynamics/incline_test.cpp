// Tests on an inclined plane. Bodies that are not round rest up to a limit. Round bodies roll down as fast as their inertia allows.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

/// The angle (rad) by which a superellipsoid with a = c has rotated about y after some seconds on an incline (rad) on which it
/// cannot slide. It starts with its face on the incline. With strong damping it rolls from one equilibrium into the next, if there
/// is one. The greatest incline is the greatest angle between a normal of the section and its contact point.
double turned_on_incline(double exponent, double incline) {
  OdeSession session;
  World world;
  world.add_plane(incline);
  world.set_friction(dInfinity);
  const auto a = dReal(0.1);
  const dGeomID geom = snCreateSuperellipsoid(world.space(), a, dReal(0.15), a, dReal(exponent), dReal(exponent));
  const dBodyID body = world.add(geom, 1000);
  turn(body, {0, 1, 0}, -incline);
  dBodySetPosition(body, dReal(-a * std::sin(incline)), 0, dReal(a * std::cos(incline)));
  dBodySetLinearDampingThreshold(body, 0);
  dBodySetAngularDampingThreshold(body, 0);
  dBodySetAngularDamping(body, dReal(0.05));  // fraction of the velocity that each step removes
  double turned = 0;
  for (int step = 0; step < 40000 && turned < std::numbers::pi; ++step) {
    world.quick_step(1e-3);
    turned += 1e-3 * std::abs(double{dBodyGetAngularVel(body)[1]});
  }
  return turned;
}

/// The greatest angle (rad) between a normal of the body and its contact point, in the plane of x and z: the greatest incline on
/// which it rests.
double greatest_incline(dGeomID geom) {
  double greatest = 0;
  for (double tilt = 1e-9; tilt < 1; tilt *= 1.01) {
    const dVector3 direction = {dReal(tilt), 0, 1};
    dVector3 point;
    REQUIRE(snGeomSupport(geom, direction, point) == 1);
    greatest = std::max(greatest, std::atan2(double{point[0]}, double{point[2]}) - std::atan(tilt));
  }
  return greatest;
}

/// Whether a body of this exponent that looks ahead stands for four seconds on an incline that differs from its greatest by `more`
/// (rad).
bool stands_ahead(double exponent, double height, double more, double step) {
  OdeSession session;
  World world;
  world.add_plane();
  world.set_friction(5);
  dWorldSetQuickStepNumIterations(world.id(), 100);
  const dGeomID geom =
      snCreateSuperellipsoid(world.space(), dReal(0.1), dReal(0.1), dReal(height), dReal(exponent), dReal(exponent));
  const double incline = greatest_incline(geom) + more;
  dWorldSetGravity(world.id(), dReal(kGravity * std::sin(incline)), 0, dReal(-kGravity * std::cos(incline)));
  const dBodyID body = world.add(geom, 1000);
  dBodySetPosition(body, 0, 0, dReal(height));
  REQUIRE(snGeomSetLookAhead(geom, dReal(step)) == 1);
  bool stands = true;
  for (int k = 0; k < 4 / step && stands; ++k) {
    world.quick_step(step);
    stands = dBodyGetRotation(body)[10] > dReal(0.7);
  }
  return stands;
}

/// The acceleration a / (g sin theta) of a superellipsoid whose circular equator rolls down an incline at steps of `dt` (s).
double acceleration(double epsilon, double dt = 1e-3, bool looks_ahead = false) {
  const double incline = 20 * kDegree;
  OdeSession session;
  World world;
  world.add_plane(incline);
  world.surface.mu = dInfinity;
  // All contacts of the line stick. At 20 iterations quickstep lets it slip by 1e-4 of its speed.
  dWorldSetQuickStepNumIterations(world.id(), 1000);
  const auto a = dReal(0.1);
  const dGeomID geom = snCreateSuperellipsoid(world.space(), a, a, dReal(0.15), 2, dReal(epsilon));
  const dBodyID body = world.add(geom, 1000);
  turn(body, {1, 0, 0}, std::numbers::pi / 2);
  const Vec start = double{a} * Vec{-std::sin(incline), 0, std::cos(incline)};
  dBodySetPosition(body, dReal(start[0]), 0, dReal(start[2]));
  if (looks_ahead) REQUIRE(snGeomSetLookAhead(geom, dReal(dt)) == 1);
  const int steps = static_cast<int>(std::lround(1 / dt));
  for (int step = 0; step < steps; ++step) world.quick_step(dt);
  const double speed = norm(to_vec(dBodyGetLinearVel(body)));
  return speed / (steps * dt * kGravity * std::sin(incline));
}

/// A body on an incline that friction holds.
struct Creeping {
  double delta, epsilon;
  std::array<double, 3> half_axes;
  Vec lying_axis;  // it is rotated by 90 degrees about this axis; not if it is 0
};

enum class Slope { Plane, LargeBox };

/// The speed of the body down the incline (rad) once it lies there, m/s.
double creep(const Creeping& what, Slope slope, double incline, double step, int room) {
  OdeSession session;
  World world;
  if (slope == Slope::Plane) {
    dCreatePlane(world.space(), 0, 0, 1, 0);
  } else {
    dGeomSetPosition(dCreateBox(world.space(), 20, 20, 10), 0, 0, -5);
  }
  dWorldSetGravity(world.id(), dReal(kGravity * std::sin(incline)), 0, dReal(-kGravity * std::cos(incline)));
  dWorldSetQuickStepNumIterations(world.id(), 100);
  world.set_friction(0.5);
  world.room = room;
  const auto [a, b, c] = what.half_axes;
  const dGeomID geom = snCreateSuperellipsoid(world.space(), dReal(a), dReal(b), dReal(c), dReal(what.delta), dReal(what.epsilon));
  const dBodyID body = world.add(geom, 2600);
  const bool lies = norm(what.lying_axis) > 0;
  if (lies) turn(body, what.lying_axis, std::numbers::pi / 2);
  dBodySetPosition(body, 0, 0, dReal(lies ? a : c));
  const int steps = static_cast<int>(3 / step);
  for (int k = 0; k < steps; ++k) world.quick_step(step);
  const double start{dBodyGetPosition(body)[0]};
  for (int k = 0; k < steps; ++k) world.quick_step(step);
  return (double{dBodyGetPosition(body)[0]} - start) / (steps * step);
}

}  // namespace

TEST_CASE("a superellipsoid rests on an incline exactly up to the limit of its section") {
  // tests/data/README.md: "Greatest incline on which a superellipse section (a = c) can rest without sliding: exponent 4:
  // 19.4712 deg; 8: 30.3696 deg"
  struct Case {
    double exponent;
    double limit;  // degrees
  };
  for (const Case& c : {Case{4, 19.4712}, Case{8, 30.3696}}) {
    CAPTURE(c.exponent);
    const double margin = 0.1;
    CHECK(turned_on_incline(c.exponent, (c.limit - margin) * kDegree) < 45 * kDegree);
    CHECK(turned_on_incline(c.exponent, (c.limit + margin) * kDegree) > 180 * kDegree);
  }
}

TEST_CASE("a body that looks ahead stands on inclines up to the greatest of its body to 1.2 degrees, at every step") {
  for (const double exponent : {6.0, 8.0, 12.0, 20.0, 60.0}) {
    for (const double height : {0.1, 0.15}) {
      for (const double step : {0.002, 0.01, 0.033}) {
        CAPTURE(exponent);
        CAPTURE(height);
        CAPTURE(step);
        CHECK(stands_ahead(exponent, height, -1.2 * kDegree, step));
        CHECK(!stands_ahead(exponent, height, 1.0 * kDegree, step));
      }
    }
  }
}

TEST_CASE("a circular equator rolls down an incline with the acceleration of the closed form") {
  // tests/data/README.md: "Rolling down an incline on a circular equator (delta = 2): a/(g sin theta) = 0.714286 (epsilon =
  // 2), 0.686033 (4), 0.673540 (8)."
  CHECK(acceleration(2) == relative(0.714286).epsilon(1e-4));
  CHECK(acceleration(4) == relative(0.686033).epsilon(1e-4));
  CHECK(acceleration(8) == relative(0.673540).epsilon(1e-4));
  for (const double step : {1e-3, 5e-3, 2e-2}) {
    CAPTURE(step);
    CHECK(acceleration(2, step, true) == relative(0.714286).epsilon(1e-4));
    // The points of the line are on the body, so the radius of their friction is smaller by a thousandth.
    CHECK(acceleration(8, step, true) == relative(1 / (1 + (1 / 0.673540 - 1) / (0.999 * 0.999))).epsilon(2e-5));
  }
}

// In single precision a micrometre is the spacing of the numbers.
TEST_CASE("what friction holds on an incline does not creep, at any exponent, step and max_contacts" *
          doctest::skip(kIsSinglePrecision)) {
  const std::array<double, 3> brick = {0.075, 0.06, 0.04};
  const std::array<double, 3> can = {0.04, 0.04, 0.12};
  std::vector<Creeping> bodies;
  for (const double exponent : {6.0, 7.0, 8.0, 12.0, 20.0, 60.0, 1000.0}) bodies.push_back({exponent, exponent, brick, {0, 0, 0}});
  bodies.push_back({2, 60, {0.08, 0.08, 0.03}, {0, 0, 0}});                                                      // a coin
  for (const double exponent : {6.0, 7.0, 9.0}) bodies.push_back({2, exponent, {0.05, 0.05, 0.03}, {0, 0, 0}});  // standing cans
  for (const double exponent : {6.0, 8.0, 60.0})
    bodies.push_back({2, exponent, can, {0, 1, 0}});          // along the slope; across the slope they roll
  bodies.push_back({2, 60, {0.01, 0.01, 0.006}, {0, 0, 0}});  // its depth at rest is only rounding
  for (const Creeping& body : bodies) {
    for (const double degrees : {5.0, 15.0, 26.0}) {
      for (const double step : {0.0005, 0.002, 0.01}) {
        for (const int room : {3, 4, 8}) {
          CAPTURE(body.delta);
          CAPTURE(body.epsilon);
          CAPTURE(degrees);
          CAPTURE(step);
          CAPTURE(room);
          CHECK(std::abs(creep(body, Slope::Plane, degrees * kDegree, step, room)) <= 5e-8);  // 0.0 um/s
          if (step > 0.001 && room == 4) CHECK(std::abs(creep(body, Slope::LargeBox, degrees * kDegree, step, room)) <= 5e-8);
        }
      }
    }
  }
}
