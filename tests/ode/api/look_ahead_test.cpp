// Tests of the functions for contacts before overlap: their refusals and their effects.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "ode/mesh_fixture.hpp"
#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

constexpr dReal kNoTime = std::numeric_limits<dReal>::quiet_NaN();
constexpr dReal kEternity = std::numeric_limits<dReal>::infinity();

dContact contact_of_depth(dReal depth) {
  dContact contact{};
  contact.geom.depth = depth;
  contact.surface.mode = dContactApprox1;
  contact.surface.mu = dReal(0.5);
  return contact;
}

Vec size_of_box(dGeomID geom) {
  dReal aabb[6];
  dGeomGetAABB(geom, aabb);
  return {double{aabb[1]} - aabb[0], double{aabb[3]} - aabb[2], double{aabb[5]} - aabb[4]};
}

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

TEST_CASE_FIXTURE(OdeSession, "an invalid look-ahead time is refused, with its value and the range, and changes nothing") {
  const Geom geom(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Vec before = size_of_box(geom);
  for (const dReal time : {dReal(-1), kNoTime, kEternity, dReal(2e6)}) {
    CHECK(refused(snGeomSetLookAhead(geom, time), "snGeomSetLookAhead: time = "));
    CHECK(refused_with("is outside [0, 1e+06] s"));
    CHECK(refused(snSetDefaultLookAhead(time), "snSetDefaultLookAhead: time = "));
  }
  CHECK(size_of_box(geom) == before);
  const Geom other(snCreateEllipsoid(nullptr, 1, 1, 1));
  CHECK(size_of_box(other) == before);
  const Geom sphere(dCreateSphere(nullptr, 1));
  CHECK(refused(snGeomSetLookAhead(sphere, dReal(0.01)), "a dSphere"));
  CHECK(snGeomSetLookAhead(nullptr, dReal(0.01)) == 0);
}

TEST_CASE("snContactLookAhead lets a gap close within the step, and does not change other contacts") {
  dContact contact = contact_of_depth(dReal(-0.5));
  snContactLookAhead(&contact, dReal(0.25));
  CHECK(contact.geom.depth == 0);
  CHECK(contact.surface.mode == (dContactApprox1 | dContactMotionN));
  CHECK(contact.surface.motionN == -2);
  // A surface that moves out already, like a piston.
  contact = contact_of_depth(dReal(-0.5));
  contact.surface.mode |= dContactMotionN;
  contact.surface.motionN = 3;
  snContactLookAhead(&contact, dReal(0.25));
  CHECK(contact.surface.motionN == 1);
  for (const dReal depth : {dReal(0), dReal(0.1)}) {
    contact = contact_of_depth(depth);
    snContactLookAhead(&contact, dReal(0.25));
    CHECK(contact.geom.depth == depth);
    CHECK(contact.surface.mode == dContactApprox1);
  }
  for (const dReal step : {dReal(0), dReal(-1), kNoTime, kEternity}) {
    contact = contact_of_depth(dReal(-0.5));
    snContactLookAhead(&contact, step);
    CHECK(refused_with("snContactLookAhead: step = "));
    CHECK(contact.geom.depth == dReal(-0.5));
    CHECK(contact.surface.mode == dContactApprox1);
  }
  // So short that ODE would get a number that is not finite.
  for (const dReal depth : {dReal(-10), -kEternity}) {
    contact = contact_of_depth(depth);
    snContactLookAhead(&contact, std::numeric_limits<dReal>::min());
    CHECK(refused_with("snContactLookAhead: step = "));
    CHECK(refused_with("but motionN must be within"));
    CHECK(contact.geom.depth == depth);
    CHECK(contact.surface.mode == dContactApprox1);
  }
  snContactLookAhead(nullptr, dReal(0.01));
  CHECK(refused_with("snContactLookAhead: contact = NULL"));
}

TEST_CASE(
    "geoms that look ahead lose four fifths of an overlap in a step, others and contacts with an ERP of their own as before") {
  struct Case {
    double time;  // s
    dReal soft_erp;
    double left;  // of the overlap, after a step
  };
  const double step = 0.01;
  for (const Case& c : {Case{step, 0, 0.2}, Case{0, 0, 0.8}, Case{step, dReal(0.5), 0.5}}) {
    OdeSession session;
    World world;
    dWorldSetGravity(world.id(), 0, 0, 0);
    world.add_plane();
    if (c.soft_erp > 0) world.surface.mode = dContactSoftERP;
    world.surface.soft_erp = c.soft_erp;
    const dGeomID geom = snCreateEllipsoid(world.space(), dReal(0.1), dReal(0.1), dReal(0.1));
    const dBodyID body = world.add(geom, 1000);
    dBodySetPosition(body, 0, 0, dReal(0.099));
    REQUIRE(snGeomSetLookAhead(geom, dReal(c.time)) == 1);
    world.quick_step(step);
    CHECK(0.1 - double{dBodyGetPosition(body)[2]} == relative(0.001 * c.left).epsilon(1e-3));
  }
}

TEST_CASE_FIXTURE(OdeSession, "the bounding box covers the motion within the look-ahead time, and only the body without it") {
  World world;
  dWorldSetGravity(world.id(), 0, 0, 0);
  const dGeomID geom = snCreateEllipsoid(world.space(), 1, 1, 1);
  const dBodyID body = world.add(geom, 1000);
  const Vec still = size_of_box(geom);
  dBodySetLinearVel(body, 100, 0, 0);
  REQUIRE(snGeomSetLookAhead(geom, dReal(0.1)) == 1);
  CHECK(size_of_box(geom)[0] == doctest::Approx(12.02));  // with one hundredth of the half-extent on both sides
  CHECK(size_of_box(geom)[1] == doctest::Approx(2.02));
  // ODE keeps the box until dGeomMoved or a move.
  dBodySetLinearVel(body, 0, 200, 0);
  CHECK(size_of_box(geom)[1] == doctest::Approx(2.02));
  dGeomMoved(geom);
  CHECK(size_of_box(geom)[1] == doctest::Approx(22.02));
  dBodySetLinearVel(body, 0, 0, 0);
  dBodySetAngularVel(body, 0, 0, 1);
  dGeomMoved(geom);
  CHECK(size_of_box(geom)[1] > 2.2);
  dBodySetAngularVel(body, 0, 0, 1000);  // at most to the other side
  dGeomMoved(geom);
  CHECK(size_of_box(geom)[1] < 14);
  REQUIRE(snGeomSetLookAhead(geom, 0) == 1);
  CHECK(size_of_box(geom) == still);
}

TEST_CASE_FIXTURE(OdeSession, "without look-ahead no contact has a negative depth, and the contacts have the same bits as before") {
  Random random(11);
  const Geom floor(dCreatePlane(nullptr, 0, 0, 1, 0));
  const Geom box(dCreateBox(nullptr, 2, 2, 2));
  place(box, {0, 0, -1});
  const Geom brick(snCreateSuperellipsoid(nullptr, dReal(0.5), dReal(0.4), dReal(0.3), 20, 20));
  const Geom other(snCreateSuperellipsoid(nullptr, 1, 1, 1, 8, 8));
  place(other, {0, 0, -1});
  snSetWarmStart(0);
  int with_contacts = 0;
  for (int k = 0; k < 300; ++k) {
    random.turn(brick);
    place(brick, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.2, 0.6)});
    for (const dGeomID collider : {dGeomID(floor), dGeomID(box), dGeomID(other)}) {
      const std::vector<dContactGeom> plain = collide(brick, collider);
      for (const dContactGeom& contact : plain) CHECK(contact.depth >= 0);
      REQUIRE(snGeomSetLookAhead(brick, dReal(0.01)) == 1);
      const std::vector<dContactGeom> ahead = collide(brick, collider);
      if (!plain.empty()) CHECK(ahead.size() >= 1);  // never fewer than without look-ahead
      with_contacts += ahead.empty() ? 0 : 1;
      REQUIRE(snGeomSetLookAhead(brick, 0) == 1);
      CHECK(same_bits(collide(brick, collider), plain));
    }
  }
  CHECK(with_contacts > 300);
}

TEST_CASE_FIXTURE(OdeSession,
                  "a geom that looks ahead with a velocity that is not finite has no contacts, and the error names the velocity") {
  World world;
  const dGeomID ours = snCreateSuperellipsoid(world.space(), 1, 1, 1, 8, 8);
  const dBodyID body = world.add(ours, 1000);
  REQUIRE(snGeomSetLookAhead(ours, dReal(0.01)) == 1);
  dBodySetPosition(body, 2, 2, dReal(0.9));
  const MeshGeom mesh(sheet_mesh(4, 4, 1));
  const Geom box(dCreateBox(nullptr, 9, 9, dReal(0.01))), plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  for (const dGeomID other : {dGeomID(mesh), dGeomID(box), dGeomID(plane)}) {
    dBodySetLinearVel(body, 0, 0, 0);
    CHECK(!collide(ours, other).empty());
    for (const dReal bad : {kNoTime, kEternity, -kEternity}) {
      dBodySetLinearVel(body, 0, bad, 0);
      CHECK(collide(ours, other).empty());
      CHECK(refused_with("dCollide: velocity of the body of a geom of this library's class = "));
    }
  }
}

TEST_CASE_FIXTURE(
    OdeSession,
    "a body that looks ahead rises to the square of its restitution times its height, at any step and place of the impact") {
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

TEST_CASE_FIXTURE(OdeSession, "where no velocity is right, a body that looks ahead rises less than it should, and never more") {
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

TEST_CASE_FIXTURE(
    OdeSession, "two bodies that look ahead leave each other and moving walls with the restitution times their approach velocity") {
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

TEST_CASE_FIXTURE(OdeSession, "bodies that look ahead come to rest after their bounces, at their height") {
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

TEST_CASE_FIXTURE(OdeSession, "a stack of bricks that look ahead rests with a restitution of 1 as with one of 0.5") {
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

TEST_CASE_FIXTURE(OdeSession, "bricks that fall on each other within steps of 20 ms gain no energy") {
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

TEST_CASE_FIXTURE(OdeSession, "a body that looks ahead bounces although a joint guides it") {
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

TEST_CASE_FIXTURE(OdeSession, "a body that looks ahead and approaches no faster than bounce_vel is stopped where it touches") {
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
