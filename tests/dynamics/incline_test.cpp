// Tests on an inclined plane: bodies that are not round rest up to a limit, round ones roll down as fast as their inertia allows.
#include <doctest/doctest.h>

#include "ode/ode_world.hpp"
#include "relative.hpp"

using namespace supernormal::test;

namespace {

/// The angle (rad) by which a superellipsoid with a = c has turned about y after some seconds on an incline (rad) that it cannot
/// slide down. It is put down with its face on the incline; heavily damped, it rolls from one equilibrium into the next, if there
/// is one: the greatest incline is the greatest angle between a normal of the section and its contact point.
double turned_on_incline(double exponent, double incline) {
  OdeSession session;
  World world;
  world.add_plane(incline);
  world.surface.mode = dContactApprox1;
  world.surface.mu = dInfinity;
  const auto a = dReal(0.1);
  const dGeomID geom = snCreateSuperellipsoid(world.space(), a, dReal(0.15), a, dReal(exponent), dReal(exponent));
  const dBodyID body = world.add(geom, 1000);
  turn(body, {0, 1, 0}, -incline);
  dBodySetPosition(body, dReal(-a * std::sin(incline)), 0, dReal(a * std::cos(incline)));
  dBodySetLinearDampingThreshold(body, 0);
  dBodySetAngularDampingThreshold(body, 0);
  dBodySetAngularDamping(body, dReal(0.05));  // share of the velocity that each step takes away
  double turned = 0;
  for (int step = 0; step < 40000 && turned < std::numbers::pi; ++step) {
    world.quick_step(1e-3);
    turned += 1e-3 * std::abs(double{dBodyGetAngularVel(body)[1]});
  }
  return turned;
}

/// The acceleration a / (g sin theta) of a superellipsoid whose circular equator rolls down an incline.
double acceleration(double epsilon) {
  const double incline = 20 * kDegree;
  OdeSession session;
  World world;
  world.add_plane(incline);
  world.surface.mu = dInfinity;
  // There is a line of contacts that all stick: at 20 iterations quickstep lets it slip by 1e-4 of its speed.
  dWorldSetQuickStepNumIterations(world.id(), 1000);
  const auto a = dReal(0.1);
  const dGeomID geom = snCreateSuperellipsoid(world.space(), a, a, dReal(0.15), 2, dReal(epsilon));
  const dBodyID body = world.add(geom, 1000);
  turn(body, {1, 0, 0}, std::numbers::pi / 2);
  const Vec start = double{a} * Vec{-std::sin(incline), 0, std::cos(incline)};
  dBodySetPosition(body, dReal(start[0]), 0, dReal(start[2]));
  const double dt = 1e-3;
  const int steps = 1000;
  for (int step = 0; step < steps; ++step) world.quick_step(dt);
  const double speed = norm(to_vec(dBodyGetLinearVel(body)));
  return speed / (steps * dt * kGravity * std::sin(incline));
}

}  // namespace

TEST_CASE("a superellipsoid rests on an incline up to the limit of its section and not beyond") {
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

TEST_CASE("a circular equator rolls down an incline as the closed form says") {
  // tests/data/README.md: "Rolling down an incline on a circular equator (delta = 2): a/(g sin theta) = 0.714286 (epsilon =
  // 2), 0.686033 (4), 0.673540 (8)."
  CHECK(acceleration(2) == relative(0.714286).epsilon(1e-4));
  CHECK(acceleration(4) == relative(0.686033).epsilon(1e-4));
  CHECK(acceleration(8) == relative(0.673540).epsilon(1e-4));
}
