// Tests of bounces of bodies that look ahead, in C: their heights and velocities, their rest afterwards, and refusals.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

constexpr double kHalfExtent = 0.05;  // m

void let_bounce(World& world, double restitution, double threshold = 0) {
  world.surface.mode = dContactApprox1 | dContactBounce;
  world.surface.mu = dReal(0.3);
  world.surface.bounce = dReal(restitution);
  world.surface.bounce_vel = dReal(threshold);
}

/// Adds a body that looks ahead by `step` (s): a ball, or a brick with faces.
dBodyID add_body(World& world, bool is_brick, double step, const Vec& place, double density = 2000) {
  const double exponent = is_brick ? 20 : 2;
  const auto half = dReal(kHalfExtent);
  const dGeomID geom = snCreateSuperellipsoid(world.space(), half, half, half, dReal(exponent), dReal(exponent));
  REQUIRE(snGeomSetLookAhead(geom, dReal(step)) == 1);
  const dBodyID body = world.add(geom, density);
  dBodySetPosition(body, dReal(place[0]), dReal(place[1]), dReal(place[2]));
  return body;
}

double height_of(dBodyID body) { return double{dBodyGetPosition(body)[2]} - kHalfExtent; }

/// m; from where a body falls that ODE starts with velocity 0 at a height: that of the middle of the step before.
double start_of_fall(double height, double step) { return height + kGravity * step * step / 8; }

/// m; how high a falling body rises when it falls no longer. ODE's velocity is that of the middle of the last step.
double rise_after_bounce(World& world, dBodyID body, double step) {
  int steps = 0;
  do {
    world.quick_step(step);
    REQUIRE(++steps < 10000);
  } while (!(dBodyGetLinearVel(body)[2] > -1e-3 * kGravity * step));
  const double velocity = double{dBodyGetLinearVel(body)[2]} - kGravity * step / 2;
  return height_of(body) + velocity * velocity / (2 * kGravity);
}

}  // namespace

TEST_CASE("a body that looks ahead rises to the square of its restitution times its height, at any step and place of the impact") {
  OdeSession session;
  for (const bool is_brick : {false, true}) {
    for (const double step : {0.001, 0.005, 0.02}) {
      for (const double restitution : {0.5, 0.8, 1.0}) {
        for (int phase = 0; phase < 8; ++phase) {
          World world;
          world.add_plane();
          let_bounce(world, restitution);
          const double height = 0.5 * (1 + 0.01 * phase);
          const dBodyID body = add_body(world, is_brick, step, {0, 0, kHalfExtent + height});
          CAPTURE(step);
          CAPTURE(restitution);
          CAPTURE(height);
          CAPTURE(is_brick);
          CHECK(rise_after_bounce(world, body, step) ==
                relative(restitution * restitution * start_of_fall(height, step)).epsilon(1e-4));
        }
      }
    }
  }
}

TEST_CASE("where no velocity is right, a body that looks ahead rises less than it should, and never more") {
  OdeSession session;
  const double step = 0.02;
  for (const double restitution : {0.2, 0.5}) {
    for (int phase = 0; phase < 40; ++phase) {
      World world;
      world.add_plane();
      let_bounce(world, restitution);
      const double height = 0.02 * (1 + 0.05 * phase);
      const dBodyID body = add_body(world, false, step, {0, 0, kHalfExtent + height});
      CAPTURE(restitution);
      CAPTURE(height);
      CHECK(rise_after_bounce(world, body, step) < 1.0001 * restitution * restitution * start_of_fall(height, step));
    }
  }
}

TEST_CASE("two bodies that look ahead leave each other and moving walls with the restitution times their approach velocity") {
  OdeSession session;
  const double step = 0.01;
  for (const bool is_brick : {false, true}) {
    for (const double restitution : {0.5, 1.0}) {
      for (const bool other_is_kinematic : {false, true}) {
        World world;
        dWorldSetGravity(world.id(), 0, 0, 0);
        dWorldSetContactMaxCorrectingVel(world.id(), dReal(0.01));  // a bounce is no correction
        let_bounce(world, restitution);
        const dBodyID body = add_body(world, is_brick, step, {0, 0, 0});
        const dBodyID other = add_body(world, is_brick, step, {0.25, 0, 0}, 6000);
        if (other_is_kinematic) dBodySetKinematic(other);
        dBodySetLinearVel(body, 3, 0, 0);
        dBodySetLinearVel(other, -1, 0, 0);
        for (int k = 0; k < 10; ++k) world.quick_step(step);
        const double parting = double{dBodyGetLinearVel(other)[0]} - double{dBodyGetLinearVel(body)[0]};
        CHECK(parting == relative(4 * restitution).epsilon(1e-3));
        if (other_is_kinematic) CHECK(dBodyGetLinearVel(other)[0] == -1);
      }
    }
  }
}

TEST_CASE("bodies that look ahead come to rest after their bounces, at their height") {
  OdeSession session;
  for (const bool is_brick : {false, true}) {
    for (const double step : {0.005, 0.02}) {
      World world;
      const bool is_static_body = is_brick;  // a floor that is a geom without a body, or a plane
      if (is_static_body) {
        dGeomSetPosition(snCreateSuperellipsoid(world.space(), 2, 2, 1, 60, 60), 0, 0, -1);
      } else {
        world.add_plane();
      }
      let_bounce(world, 0.5);
      const dBodyID body = add_body(world, is_brick, step, {0, 0, kHalfExtent + 0.2});
      for (int k = 0; k < static_cast<int>(3 / step); ++k) world.quick_step(step);
      double fastest = 0;
      for (int k = 0; k < 20; ++k) {
        world.quick_step(step);
        fastest = std::max(fastest, std::abs(double{dBodyGetLinearVel(body)[2]}));
      }
      CAPTURE(step);
      CAPTURE(is_brick);
      CHECK(fastest < 1e-3 * kGravity * step);
      CHECK(std::abs(height_of(body)) < 1e-3 * kHalfExtent);
    }
  }
}

TEST_CASE("a stack of bricks that look ahead rests with a restitution of 1 as with one of 0.5") {
  OdeSession session;
  const auto heights = [](double restitution) {
    dRandSetSeed(1);
    World world;
    dWorldSetQuickStepNumIterations(world.id(), 40);
    world.add_plane();
    let_bounce(world, restitution);
    std::array<dBodyID, 4> bricks;
    for (std::size_t k = 0; k < bricks.size(); ++k)
      bricks.at(k) = add_body(world, true, 0.01, {0, 0, kHalfExtent * (2 * static_cast<double>(k) + 1)});
    for (int k = 0; k < 100; ++k) world.quick_step(0.01);
    std::array<double, 4> result;
    std::ranges::transform(bricks, result.begin(), [](dBodyID body) { return height_of(body); });
    return result;
  };
  CHECK(heights(1) == heights(0.5));
}

TEST_CASE("bricks that fall on each other within steps of 20 ms gain no energy") {
  OdeSession session;
  const double step = 0.02;
  World world;
  dWorldSetQuickStepNumIterations(world.id(), 40);
  world.add_plane();
  let_bounce(world, 0.5);
  std::array<dBodyID, 5> bodies;
  for (std::size_t k = 0; k < bodies.size(); ++k)
    bodies.at(k) = add_body(world, true, step, {0, 0, 0.06 + 0.11 * static_cast<double>(k)});
  const auto total = [&] {
    return std::accumulate(bodies.begin(), bodies.end(), 0.0, [](double sum, dBodyID body) { return sum + energy(body); });
  };
  const double before = total();
  for (int k = 0; k < 50; ++k) {
    world.quick_step(step);
    CHECK(total() < before);
  }
}

TEST_CASE("a body that looks ahead bounces although a joint guides it") {
  OdeSession session;
  const double step = 0.01;
  World world;
  world.add_plane();
  let_bounce(world, 0.8);
  const dBodyID body = add_body(world, true, step, {0, 0, kHalfExtent + 0.5});
  const dJointID guide = dJointCreateSlider(world.id(), nullptr);
  dJointAttach(guide, body, nullptr);
  dJointSetSliderAxis(guide, 0, 0, 1);
  CHECK(rise_after_bounce(world, body, step) == relative(0.64 * start_of_fall(0.5, step)).epsilon(1e-4));
}

TEST_CASE("a body that looks ahead and approaches no faster than bounce_vel is stopped where it touches") {
  OdeSession session;
  const double step = 0.01;
  for (const double threshold : {0.5, 1.5, -1.0}) {
    World world;
    dWorldSetGravity(world.id(), 0, 0, 0);
    world.add_plane();
    let_bounce(world, 1, threshold);
    const dBodyID body = add_body(world, false, step, {0, 0, kHalfExtent + 0.005});
    dBodySetLinearVel(body, 0, 0, -1);
    world.quick_step(step);
    const double expected = threshold == 0.5 ? 1 : -0.5;  // -0.5: the gap over the step
    CHECK(dBodyGetLinearVel(body)[2] == relative(expected).epsilon(1e-3));
  }
}

TEST_CASE("a restitution outside [0, 1] of a contact ahead is refused, and the contact stays as it is") {
  for (const dReal restitution : {dReal(-0.1), dReal(1.1), std::numeric_limits<dReal>::quiet_NaN()}) {
    dContact contact{};
    contact.geom.depth = dReal(-0.5);
    contact.surface.mode = dContactBounce;
    contact.surface.bounce = restitution;
    snContactLookAhead(&contact, dReal(0.01));
    CHECK(refused_with("snContactLookAhead: surface.bounce = "));
    CHECK(refused_with("is outside [0, 1]"));
    CHECK(contact.geom.depth == dReal(-0.5));
    CHECK(contact.surface.mode == dContactBounce);
  }
}
