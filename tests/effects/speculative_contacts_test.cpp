// Contacts before overlap with each effect: closed forms at long steps, and no force before touch.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "effects/effects_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

double height_of(dBodyID body) { return dBodyGetPosition(body)[2]; }
double speed_up(dBodyID body) { return dBodyGetLinearVel(body)[2]; }

/// m; how high a body will rise. ODE's steps lie on a parabola whose velocity is half a step of gravity ahead of ODE's velocity.
double top_of_flight(dBodyID body, double step) {
  const double velocity = speed_up(body) - kGravity * step / 2;
  return height_of(body) + velocity * velocity / (2 * kGravity);
}

std::vector<dReal> state_of(dBodyID body) {
  std::vector<dReal> state(dBodyGetPosition(body), dBodyGetPosition(body) + 3);
  state.insert(state.end(), dBodyGetLinearVel(body), dBodyGetLinearVel(body) + 3);
  state.insert(state.end(), dBodyGetAngularVel(body), dBodyGetAngularVel(body) + 3);
  return state;
}

/// A ball that falls onto a plane, step by step.
std::vector<std::vector<dReal>> falling_ball(const std::vector<fx::Effect>& list, double step, double look_ahead = 0) {
  OnPlane scene(list, step);
  const dGeomID geom = snCreateEllipsoid(scene.world.space(), dReal(kRadius), dReal(kRadius), dReal(kRadius));
  const dBodyID ball = scene.add(geom, kDensity, {0, 0, 0.05});
  if (look_ahead > 0) REQUIRE(snGeomSetLookAhead(geom, dReal(look_ahead)) == 1);
  std::vector<std::vector<dReal>> states;
  for (int k = 0; k * step < 0.3; ++k) {
    scene.step();
    states.push_back(state_of(ball));
  }
  return states;
}

}  // namespace

TEST_CASE("speculative contacts: a ball bounces to e^2 h at steps of 1 to 20 ms") {
  for (const double e : {0.2, 0.5, 0.8, 1.0}) {
    for (const double step : {1e-3, 2e-3, 5e-3, 10e-3, 20e-3}) {
      for (const double height : {0.5, 0.6, 0.77, 1.1}) {
        CAPTURE(e);
        CAPTURE(step);
        CAPTURE(height);
        OnPlane scene({earth(), fx::Restitution{e, 0.05, {}}, fx::SpeculativeContacts{}}, step);
        const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + height});
        double top = height;
        // A step of this length cannot resolve a flight of fewer than five steps.
        for (int bounce = 0; bounce < 4 && 2 * e * std::sqrt(2 * top / kGravity) > 5 * step; ++bounce) {
          scene.run_until(3, [&] { return speed_up(ball) > 0; });
          const double reached = top_of_flight(ball, step) - kRadius;
          CHECK(reached == relative(e * e * top).epsilon(0.01));
          CHECK(height_of(ball) >= kRadius * (1 - within_rounding(1e-9, 100)));
          top = reached;
          scene.run_until(3, [&] { return speed_up(ball) < 0; });
        }
      }
    }
  }
}

TEST_CASE("speculative contacts: a fast body leaves a wall with e times its velocity, from where it touches") {
  for (const double speed : {3.0, 100.0, 3000.0}) {
    for (const double step : {1e-3, 20e-3}) {
      for (const double part : {0.1, 0.5, 0.99}) {  // the fraction of the step until touch
        CAPTURE(speed);
        CAPTURE(step);
        CAPTURE(part);
        EffectsWorld scene({fx::Restitution{0.6, 0, {}}, fx::MaxCorrectingVelocity{0.05}, fx::SpeculativeContacts{}}, step);
        dWorldSetCFM(scene.id(), 0);
        place(dCreateBox(scene.world.space(), 1, 1, dReal(0.01)), {0, 0, -0.005});
        const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + part * step * speed});
        throw_body(ball, {0, 0, -speed});
        scene.step();
        CHECK(speed_up(ball) == relative(0.6 * speed).epsilon(within_rounding(1e-9, 100)));
        CHECK(height_of(ball) == relative(kRadius + 0.6 * speed * step).epsilon(within_rounding(1e-6, 10)));
      }
    }
  }
}

TEST_CASE("speculative contacts: two bodies part with e times their approach velocity, and their centre of mass keeps its motion") {
  Random random(5);
  for (int pair = 0; pair < 100; ++pair) {
    CAPTURE(pair);
    const double step = random.uniform(1e-3, 20e-3);
    const double e = random.uniform(0.2, 1);
    EffectsWorld scene({fx::Restitution{e, 0, {}}, fx::SpeculativeContacts{}}, step);
    dWorldSetCFM(scene.id(), 0);
    dWorldSetQuickStepNumIterations(scene.id(), 60);
    const double radius2 = random.uniform(0.5, 2) * kRadius;
    const double v = random.uniform(0.2, 5);
    const dBodyID one = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + random.uniform(0.05, 0.95) * v * step});
    const dBodyID two = scene.add_ball(radius2, kDensity, {0, 0, -radius2});
    dBodySetLinearVel(one, 1, 0, dReal(2 - v));
    dBodySetLinearVel(two, 1, 0, 2);
    for (const dBodyID body : {one, two}) dGeomMoved(dBodyGetFirstGeom(body));
    const double mass = mass_of(one) + mass_of(two);
    const auto centre = [&] { return (mass_of(one) * height_of(one) + mass_of(two) * height_of(two)) / mass; };
    const auto motion = [&] { return (mass_of(one) * speed_up(one) + mass_of(two) * speed_up(two)) / mass; };
    const double start = centre();
    const double before = motion();
    scene.step();
    CHECK(speed_up(one) - speed_up(two) == relative(e * v).epsilon(within_rounding(1e-9, 100)));
    CHECK(motion() == doctest::Approx(before).epsilon(within_rounding(1e-12, 100)));
    CHECK(centre() == doctest::Approx(start + step * before).epsilon(within_rounding(1e-12, 100)));
    CHECK(height_of(one) - height_of(two) >= kRadius + radius2);
  }
}

namespace {

/// Balls in a row that rest, and one that comes from below at 1 m/s, with all gaps alike. `order`: of their creation, and so of the
/// pairs.
std::vector<double> cradle(double gap, double step, double e, const std::vector<int>& order, bool has_wall = false) {
  EffectsWorld scene({fx::Restitution{e, 0, {}}, fx::SpeculativeContacts{}}, step);
  dWorldSetQuickStepNumIterations(scene.id(), 60);
  const double pitch = 2 * kRadius + gap;
  const auto last = static_cast<double>(order.size() - 1);
  if (has_wall) dCreatePlane(scene.world.space(), 0, 0, -1, dReal(-(last * pitch + kRadius + gap)));
  std::vector<dBodyID> balls(order.size());
  for (const int k : order) balls[static_cast<std::size_t>(k)] = scene.add_ball(kRadius, kDensity, {0, 0, k * pitch});
  dBodySetPosition(balls.front(), 0, 0, dReal(-0.05));
  dBodySetLinearVel(balls.front(), 0, 0, 1);
  scene.run_until(0.1 + 10 * gap);
  std::vector<double> velocities;
  velocities.reserve(balls.size());
  for (const dBodyID ball : balls) velocities.push_back(speed_up(ball));
  return velocities;
}

}  // namespace

TEST_CASE("speculative contacts: Newton's cradle passes the velocity on, whatever its gaps and the order of its balls") {
  for (const double gap : {1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2}) {
    for (const double step : {1e-3, 5e-3, 20e-3}) {
      for (const std::vector<int>& order : {std::vector{0, 1, 2, 3, 4}, {4, 3, 2, 1, 0}, {2, 4, 0, 3, 1}}) {
        CAPTURE(gap);
        CAPTURE(step);
        const std::vector<double> velocities = cradle(gap, step, 1, order);
        for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(velocities[k]) < 0.01);
        CHECK(velocities[4] == relative(1).epsilon(1e-4));
      }
      // Each impact passes on the fraction (1 + e) / 2.
      const std::vector<double> velocities = cradle(gap, step, 0.9, {0, 1, 2, 3, 4});
      CHECK(velocities[4] >= 0.99 * std::pow(0.95, 4));
      CHECK(std::accumulate(velocities.begin(), velocities.end(), 0.0) == relative(1).epsilon(within_rounding(1e-9, 1000)));
      // The first ball comes back from a ball at a wall.
      for (const std::vector<int>& order : {std::vector{0, 1}, {1, 0}}) {
        const std::vector<double> from_wall = cradle(gap, step, 1, order, true);
        CHECK(from_wall[0] == relative(-1).epsilon(1e-4));
        CHECK(std::abs(from_wall[1]) < 0.01);
      }
    }
  }
}

TEST_CASE("speculative contacts: a face bounces as one, also if a step ends between the touches of its corners") {
  constexpr double kTilt = 1e-6;  // rad; the touches of the corners are 2e-8 s apart
  for (int part = -4; part <= 4; ++part) {
    CAPTURE(part);
    OnPlane scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, kLongStep);
    const auto size = dReal(kRadius);
    const dGeomID geom = snCreateSuperellipsoid(scene.world.space(), size, size, size, 8, 8);
    const dBodyID brick = scene.add(geom, kDensity, {0, 0, kRadius + kLongStep + part * kTilt * kRadius / 4});
    turn(brick, {1, 1, 0}, kTilt);
    dBodySetLinearVel(brick, 0, 0, -1);
    dGeomMoved(geom);
    scene.run_until(3 * kLongStep);
    CHECK(speed_up(brick) == relative(1).epsilon(1e-4));
    CHECK(norm(to_vec(dBodyGetAngularVel(brick))) * kRadius < 0.01);
  }
}

TEST_CASE("speculative contacts: the forces of a chain of impacts are those that the program measures") {
  const double step = 5e-3;
  OnPlane scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, step);
  dWorldSetQuickStepNumIterations(scene.id(), 60);
  const dBodyID low = scene.add_ball(kRadius, kDensity, {0, 0, kRadius});
  const dBodyID high = scene.add_ball(kRadius, kDensity, {0, 0, 3 * kRadius + 2e-3});
  throw_body(high, {0, 0, -1});
  scene.step();
  CHECK(speed_up(high) == relative(1).epsilon(1e-3));
  double from_plane = 0;
  double on_both = 0;
  REQUIRE(scene.loads.size() == 2);
  for (const Load& load : scene.loads) {
    const double impulse = std::abs(load.force[2]) * step;
    on_both += impulse;
    from_plane = impulse;
  }
  // Two impacts between the balls and one at the plane, each of m v, and 2 m v.
  CHECK(on_both == relative(4 * mass_of(low)).epsilon(1e-3));
  CHECK(from_plane == relative(2 * mass_of(low)).epsilon(1e-3));
}

TEST_CASE("speculative contacts: a program that attaches contacts of its own keeps all of them") {
  EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 5e-3);
  dWorldSetQuickStepNumIterations(scene.id(), 60);
  std::vector<dBodyID> balls;
  balls.reserve(3);
  for (int k = 0; k < 3; ++k) balls.push_back(scene.add_ball(kRadius, kDensity, {0, 0, -2 * kRadius * k + (k > 0 ? -1e-3 : 0)}));
  dContact inert{};
  inert.geom.normal[2] = 1;
  inert.surface.mode = dContactMotionN;
  inert.surface.motionN = -1000;
  const dJointID own = dJointCreateContact(scene.id(), nullptr, &inert);
  dJointAttach(own, balls[1], balls[2]);
  dBodySetLinearVel(balls[0], 0, 0, -1);
  dGeomMoved(dBodyGetFirstGeom(balls[0]));
  scene.step();
  CHECK(dJointIsEnabled(own) == 1);
  // Two balls that touch act as one.
  CHECK(speed_up(balls[0]) == relative(1.0 / 3).epsilon(1e-4));
  CHECK(speed_up(balls[2]) == relative(-2.0 / 3).epsilon(1e-4));
}

namespace {

/// The largest change of the energy of a gas in 2 s, relative. Without ODE's gyroscopic torques, which take up to a tenth of the
/// energy of bodies that are not balls.
double change_in_gas(const Vec& half_axes, double exponent, double step, unsigned seed, int iterations) {
  EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, step);
  dWorldSetQuickStepNumIterations(scene.id(), iterations);
  for (int axis = 0; axis < 3; ++axis) {
    const std::array<double, 3> n = {axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0};
    dCreatePlane(scene.world.space(), dReal(n[0]), dReal(n[1]), dReal(n[2]), 0);
    dCreatePlane(scene.world.space(), dReal(-n[0]), dReal(-n[1]), dReal(-n[2]), dReal(-0.3));
  }
  Random random(seed);
  std::vector<dBodyID> bodies;
  for (int k = 0; k < 27; ++k) {
    const int column = k % 3, row = k / 3 % 3, layer = k / 9;
    const dBodyID body = scene.add_body(half_axes, exponent, kDensity, {0.05 + 0.1 * column, 0.05 + 0.1 * row, 0.05 + 0.1 * layer});
    bodies.push_back(body);
    random.turn(dBodyGetFirstGeom(body));
    dBodySetGyroscopicMode(body, 0);
    throw_body(body, random.uniform(0.2, 1) * random.direction());
  }
  const double start = sum_of(bodies, kinetic_energy);
  double change = 0;
  for (int k = 0; k * step < 2; ++k) {
    scene.step();
    change = std::max(change, std::abs(sum_of(bodies, kinetic_energy) / start - 1));
  }
  for (const dBodyID body : bodies) {
    for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(dBodyGetPosition(body)[axis] - 0.15) < 0.15);
  }
  return change;
}

}  // namespace

TEST_CASE("speculative contacts: an elastic gas of balls and bricks keeps its energy") {
  for (const double exponent : {2.0, 4.0, 8.0, 20.0}) {
    for (const double step : {1e-3, 5e-3, 10e-3, 20e-3, 50e-3}) {
      CAPTURE(exponent);
      CAPTURE(step);
      const double width = exponent > 2 ? 0.8 : 1;
      CHECK(change_in_gas({0.025, 0.025 * width, 0.025 * width * width}, exponent, step, 8, 20) < 0.01);
    }
  }
}

// A needle that an impact sets spinning meets a wall with its other end.
TEST_CASE("speculative contacts: an elastic gas of needles keeps its energy at a step of 50 ms") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    CHECK(change_in_gas({0.04, 0.008, 0.008}, 8, 50e-3, seed, 200) < 0.01);
  }
}

TEST_CASE("speculative contacts: long bodies that tumble and bounce under gravity keep their energy") {
  constexpr double kFewSteps = 20e-3;  // s
  Random random(3);
  double mean = 0;
  for (int k = 0; k < 20; ++k) {
    OdeSession session;
    EffectsWorld scene({earth(), fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, kFewSteps);
    scene.world.add_plane();
    const dGeomID capsule = snCreateCapsule(scene.world.space(), dReal(kRadius), dReal(20 * kRadius));
    const dBodyID body = scene.add(capsule, kDensity, {0, 0, 0.5});
    random.turn(capsule);
    dBodySetGyroscopicMode(body, 0);
    scene.run_until(2);
    const double rise = speed_up(body) * kGravity * kFewSteps / 2;  // of the parabola: see top_of_flight()
    mean += (energy(body) / mass_of(body) - rise) / (20 * kGravity * 0.5);
  }
  CHECK(mean == relative(1).epsilon(5e-3));
}

TEST_CASE("speculative contacts: springs exert no force before touch") {
  const std::vector<fx::Effect> springs = {fx::Compliance{2000, 0.5, {}}, fx::Compliance{2000, 0, {}},
                                           fx::Hertz{5e7, 0.3, 0.8, {}}};
  for (const fx::Effect& spring : springs) {
    for (const double step : {1e-4, 2e-3}) {
      const auto plain = falling_ball({earth(), fx::Friction{0.4, {}}, spring}, step);
      const auto ahead = falling_ball({earth(), fx::Friction{0.4, {}}, spring, fx::SpeculativeContacts{}}, step);
      CHECK(ahead == plain);
    }
  }
}

TEST_CASE("speculative contacts: without the effect contacts ahead are ignored, and with it other contacts stay the same") {
  for (const fx::Effect& other : std::vector<fx::Effect>{fx::Friction{0.4, {}}, fx::Restitution{0.5, 0, {}}, fx::Adhesion{1, {}}}) {
    CHECK(falling_ball({earth(), other}, 2e-3, 2e-3) == falling_ball({earth(), other}, 2e-3));
  }
  OdeSession session;
  const Geom one(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom two(snCreateEllipsoid(nullptr, 1, 1, 1));
  const auto contact_of = [&](double depth) {
    dContact contact{};
    contact.geom.g1 = one;
    contact.geom.g2 = two;
    contact.geom.normal[2] = 1;
    contact.geom.depth = dReal(depth);
    return contact;
  };
  const std::vector<dContact> all = {contact_of(-0.1), contact_of(0.2), contact_of(-0.3), contact_of(0)};
  for (const bool is_listed : {false, true}) {
    const fx::Effect friction = fx::Friction{0.4, {}};
    fx::Effects effects(is_listed ? std::vector{friction, fx::Effect(fx::SpeculativeContacts{})} : std::vector{friction}, 0.1);
    std::vector<dContact> contacts = all;
    CHECK(effects.set_up_contacts(contacts) == (is_listed ? 4 : 2));
    CHECK(contacts[0].geom.depth == dReal(0.2));
    CHECK(contacts[1].geom.depth == 0);
    CHECK((contacts[1].surface.mode & dContactMotionN) == 0);
    if (!is_listed) {
      CHECK(contacts[2].geom.depth == dReal(-0.1));
      continue;
    }
    CHECK(contacts[2].geom.depth == 0);
    CHECK(contacts[2].surface.motionN == relative(-1).epsilon(1e-6));
    CHECK(contacts[3].surface.motionN == relative(-3).epsilon(1e-6));
    CHECK(contacts[3].surface.mu > 0);
    CHECK(cost_of(effects, "speculative_contacts").contacts == 2);
  }
  fx::Effects of_pair({fx::SpeculativeContacts{fx::MaterialSelector::between(1, 2)}}, 0.1);
  for (const fx::Material material : {0, 1, 2}) {
    std::vector<dContact> contacts = all;
    CHECK(of_pair.set_up_contacts(contacts, 1, material) == (material == 2 ? 4 : 2));
  }
}

TEST_CASE_FIXTURE(OdeSession,
                  "speculative contacts: added bodies lose four fifths of an overlap in a step, and no other pair does") {
  for (const bool is_added : {true, false}) {
    fx::Effects effects({fx::SpeculativeContacts{}}, 0.01);
    World world;
    const dGeomID wall = dCreatePlane(world.space(), 0, 0, 1, 0);
    const dGeomID geom = snCreateEllipsoid(world.space(), 1, 1, 1);
    const dBodyID body = world.add(geom, 1000);
    if (is_added) effects.add_body(body);
    dContact contact{};
    contact.geom.g1 = geom;
    contact.geom.g2 = wall;
    contact.geom.normal[2] = 1;
    contact.geom.depth = dReal(0.1);
    REQUIRE(effects.set_up_contacts({&contact, 1}) == 1);
    CHECK((contact.surface.mode & dContactSoftERP) == (is_added ? dContactSoftERP : 0));
    if (is_added) CHECK(contact.surface.soft_erp == relative(0.8).epsilon(1e-6));
  }
}

TEST_CASE("speculative contacts: adhesion pulls from touch on and holds the body") {
  const double step = 5e-3;
  EffectsWorld scene({earth(), fx::Adhesion{10, {}}, fx::SpeculativeContacts{}}, step);
  dCreatePlane(scene.world.space(), 0, 0, -1, 0);  // a ceiling
  const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, -kRadius - 0.02});
  dBodySetLinearVel(ball, 0, 0, 2);
  scene.step();
  CHECK(speed_up(ball) == relative(2 - kGravity * step).epsilon(1e-6));
  scene.run_until(2);
  CHECK(height_of(ball) == relative(-kRadius).epsilon(1e-3));
  CHECK(mass_of(ball) * kGravity < 10);
}

TEST_CASE("speculative contacts: restitution and friction use the velocity relative to a moving wall") {
  for (const double wall_speed : {0.5, -0.5}) {
    for (const double step : {1e-3, 10e-3}) {
      CAPTURE(wall_speed);
      CAPTURE(step);
      EffectsWorld scene({fx::Restitution{0.5, 0, {}}, fx::SpeculativeContacts{}}, step);
      const dGeomID wall = dCreateBox(scene.world.space(), 1, 1, 1);
      const dBodyID carrier = dBodyCreate(scene.id());
      dGeomSetBody(wall, carrier);
      dBodySetKinematic(carrier);
      dBodySetPosition(carrier, 0, 0, dReal(-0.5));
      dBodySetLinearVel(carrier, 0, 0, dReal(wall_speed));
      const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + 0.1});
      dBodySetLinearVel(ball, 0, 0, -3);
      scene.run_until(0.15);
      CHECK(speed_up(ball) == relative(wall_speed + 0.5 * (3 + wall_speed)).epsilon(within_rounding(1e-6, 100)));
    }
  }
  // The velocity of the side counts, even if the geom has no body.
  const double step = 10e-3;
  EffectsWorld scene({fx::Friction{0.5, {}}, fx::SpeculativeContacts{}}, step);
  const dBodyID carrier = dBodyCreate(scene.id());
  dBodySetKinematic(carrier);
  dBodySetLinearVel(carrier, 0, 0, -1);
  scene.other_body[dCreatePlane(scene.world.space(), 0, 0, 1, 0)] = carrier;
  const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + 1e-3});
  throw_body(ball, {0, 0, -1});
  scene.step();
  CHECK(speed_up(ball) == relative(-1).epsilon(1e-6));
}

TEST_CASE("speculative contacts: bodies with restitution come to rest") {
  for (const double step : {2e-3, 10e-3, 30e-3}) {
    CAPTURE(step);
    OnPlane scene({earth(), fx::Friction{0.5, {}}, fx::Restitution{0.5, 0, {}}, fx::SpeculativeContacts{}}, step);
    const dBodyID brick = scene.add_body({0.1, 0.07, 0.05}, 20, kDensity, {0, 0, 0.1});
    turn(brick, {1, 1, 0}, 5 * kDegree);
    scene.run_until(4);
    CHECK(height_of(brick) == relative(0.05).epsilon(1e-4));
    CHECK(norm(to_vec(dBodyGetLinearVel(brick))) < 0.02 * kGravity * step);
    CHECK(norm(to_vec(dBodyGetAngularVel(brick))) < 0.02 * kGravity * step / 0.05);
  }
}

TEST_CASE("speculative contacts: a stack with restitution stays at rest, and stands after a ball has hit it from above") {
  for (const double e : {0.3, 0.5, 0.9, 1.0}) {
    for (const double step : {2e-3, 10e-3}) {
      CAPTURE(e);
      CAPTURE(step);
      OnPlane scene({earth(), fx::Friction{0.5, {}}, fx::Restitution{e, 0, {}}, fx::SpeculativeContacts{}}, step);
      dWorldSetQuickStepNumIterations(scene.id(), 40);
      constexpr double kHalf = 0.05;  // m
      std::vector<dBodyID> bricks;
      bricks.reserve(4);
      for (int k = 0; k < 4; ++k) {
        bricks.push_back(scene.add_body({0.1, 0.1, kHalf}, 20, kDensity, {0, 0, (2 * k + 1) * kHalf}));
      }
      const auto check_stands = [&] {
        for (std::size_t k = 0; k < bricks.size(); ++k) {
          CHECK(height_of(bricks[k]) == relative((2 * static_cast<double>(k) + 1) * kHalf).epsilon(0.002));
          // Quickstep leaves 0.04 g h without restitution, too.
          CHECK(norm(to_vec(dBodyGetLinearVel(bricks[k]))) < 0.1 * kGravity * step);
        }
      };
      scene.run_until(1);
      check_stands();
      if (e == 1) continue;  // the ball would bounce for ever
      const dBodyID ball = scene.add_ball(0.03, kDensity, {0, 0, 0.9});
      const auto total = [&] {
        double sum = energy(ball);
        for (const dBodyID brick : bricks) sum += energy(brick);
        return sum;
      };
      const double start = total();
      double most = 0;
      scene.run_until(1, [&] {
        most = std::max(most, total());
        return false;
      });
      CHECK(most < 1.01 * start);
      dBodySetPosition(ball, 1, 0, dReal(0.03));
      dBodySetLinearVel(ball, 0, 0, 0);
      scene.run_until(6);
      check_stands();
    }
  }
}

TEST_CASE("speculative contacts: a heap that a heavy body hits stays above the floor and gains no energy") {
  for (const double e : {0.3, 0.9}) {
    for (const double exponent : {2.0, 20.0}) {
      CAPTURE(e);
      CAPTURE(exponent);
      EffectsWorld scene({earth(), fx::Friction{0.4, {}}, fx::Restitution{e, 0, {}}, fx::SpeculativeContacts{}}, 5e-3);
      place(dCreateBox(scene.world.space(), 40, 40, dReal(0.02)), {0, 0, -0.01});
      Random random(3);
      std::vector<dBodyID> bodies;
      const auto add = [&](double size, const Vec& at) {
        const dGeomID geom = snCreateSuperellipsoid(scene.world.space(), dReal(0.05 * size), dReal(0.04 * size), dReal(0.03 * size),
                                                    dReal(exponent), dReal(exponent));
        bodies.push_back(scene.add(geom, kDensity, at));
        random.turn(geom);
      };
      for (int k = 0; k < 12; ++k) {
        const int row = k / 2 % 2, layer = k / 4;
        add(random.uniform(0.7, 1.3), {0.14 * (k % 2), 0.14 * row, 0.1 + 0.14 * layer});
      }
      scene.run_until(1);
      add(2, {0.07, 0.07, 0.8});
      dBodySetLinearVel(bodies.back(), 0, 0, -5);
      dGeomMoved(dBodyGetFirstGeom(bodies.back()));
      const double start = sum_of(bodies, energy);
      double most = 0;
      double lowest = 1;
      scene.run_until(1, [&] {
        most = std::max(most, sum_of(bodies, energy));
        for (const dBodyID body : bodies) lowest = std::min(lowest, height_of(body));
        return false;
      });
      CHECK(most < 1.01 * start);
      CHECK(lowest > 0.01);
    }
  }
}

TEST_CASE("speculative contacts: bricks thrown at a wall keep their energy at restitution 1") {
  Random random(11);
  for (int body = 0; body < 60; ++body) {
    CAPTURE(body);
    OnPlane scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, random.uniform(1e-3, 20e-3));
    const auto exponent = dReal(random.uniform(2, 20));
    const dGeomID geom = snCreateSuperellipsoid(scene.world.space(), dReal(0.05), dReal(0.04), dReal(0.03), exponent, exponent);
    const dBodyID brick = scene.add(geom, kDensity, {0, 0, 0.1});
    random.turn(geom);
    dBodySetGyroscopicMode(brick, 0);
    const Vec w = random.uniform(0, 15) * random.direction();
    dBodySetLinearVel(brick, dReal(random.uniform(-1, 1)), 0, -1);
    dBodySetAngularVel(brick, dReal(w[0]), dReal(w[1]), dReal(w[2]));
    dGeomMoved(geom);
    const double start = kinetic_energy(brick);
    scene.run_until(0.3);
    CHECK(speed_up(brick) > 0);
    CHECK(kinetic_energy(brick) == relative(start).epsilon(0.01));
  }
}

TEST_CASE(
    "speculative contacts: an elastic ellipsoid between walls, also of ours, keeps its energy at a motion of its size a step") {
  for (const double wall_exponent : {0.0, 8.0, 60.0}) {  // 0: a box
    for (const double motion : {0.75, 1.0, 2.0}) {
      CAPTURE(wall_exponent);
      CAPTURE(motion);
      EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 0.01);
      dWorldSetQuickStepNumIterations(scene.id(), 40);
      constexpr double kThick = 0.5, kWide = 200;  // m; half-extents of a wall
      for (const double side : {-1.0, 1.0}) {
        const dSpaceID space = scene.world.space();
        const auto thick = dReal(kThick), wide = dReal(kWide), e = dReal(wall_exponent);
        place(e > 0 ? snCreateSuperellipsoid(space, thick, wide, wide, e, e) : dCreateBox(space, 2 * thick, 2 * wide, 2 * wide),
              {side * (0.5 + kThick), 0, 0});
      }
      const dBodyID body = scene.add_body({0.1, 0.08, 0.05}, 2, kDensity, {0.05, 0, 0});
      dBodySetGyroscopicMode(body, 0);
      Random random(3);
      random.turn(dBodyGetFirstGeom(body));
      throw_body(body, {motion * 0.1 / 0.01, 0, 0});
      const double start = kinetic_energy(body);
      scene.run_until(8);
      CHECK(kinetic_energy(body) == relative(start).epsilon(1e-3));
    }
  }
}

TEST_CASE("speculative contacts: a body that an impact throws at a wall behind does not pass it") {
  for (const bool is_plane : {false, true}) {
    for (const double exponent : {2.0, 8.0}) {
      for (const double room : {0.5, 2.0, 20.0}) {                // in radii
        for (const double motion : {0.7, 0.9, 1.1, 2.0, 10.0}) {  // of the room
          CAPTURE(is_plane);
          CAPTURE(exponent);
          CAPTURE(room);
          CAPTURE(motion);
          EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 0.01);
          const double end = kRadius * (1 + room / 2);
          for (const double side : {-1.0, 1.0}) {
            if (is_plane) dCreatePlane(scene.world.space(), dReal(-side), 0, 0, dReal(-end));
            if (!is_plane)
              place(dCreateBox(scene.world.space(), dReal(0.2 * kRadius), 100, 100), {side * (end + 0.1 * kRadius), 0, 0});
          }
          const dBodyID body = scene.add_body({kRadius, 0.8 * kRadius, 0.6 * kRadius}, exponent, kDensity, {0, 0, 0});
          dBodySetGyroscopicMode(body, 0);
          turn(body, {1, 2, 3}, motion);
          throw_body(body, {motion * room * kRadius / 0.01, 0, 0});
          const double start = kinetic_energy(body);
          for (int step = 0; step < 40; ++step) {
            scene.step();
            CHECK(std::abs(dBodyGetPosition(body)[0]) < end);
            CHECK(kinetic_energy(body) < 1.01 * start);
          }
        }
      }
    }
  }
}

TEST_CASE("speculative contacts: a ball that bounces among slanted walls passes none") {
  using supernormal::Vector3;
  Random random(3);
  const Vector3 slant(std::cos(0.5), 0, -std::sin(0.5));
  for (int draw = 0; draw < 30; ++draw) {
    CAPTURE(draw);
    EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 0.01);
    const double end = 3 * kRadius;
    const std::array<Vector3, 5> outwards = {slant, Vector3(-slant.x(), 0, slant.z()), Vector3::UnitZ(), Vector3::UnitY(),
                                             Vector3(-Vector3::UnitY())};
    const auto distance = [&](const Vector3& out) { return (std::abs(out.x()) > 0 ? slant.x() : 1) * end; };
    for (const Vector3& out : outwards) {
      dCreatePlane(scene.world.space(), dReal(-out.x()), dReal(-out.y()), dReal(-out.z()), dReal(-distance(out)));
    }
    const dBodyID ball = scene.add_body({kRadius, kRadius, kRadius}, 2, kDensity, {random.uniform(-1, 1) * kRadius, 0, 0});
    constexpr double kSpeed = 8 * kRadius / 0.01;
    throw_body(ball, {kSpeed, random.uniform(-0.3, 0.3) * kSpeed, random.uniform(-0.3, 0.3) * kSpeed});
    const double start = kinetic_energy(ball);
    for (int step = 0; step < 40; ++step) {
      scene.step();
      const dReal* const place = dBodyGetPosition(ball);
      for (const Vector3& out : outwards) CHECK(out.dot(Vector3(place[0], place[1], place[2])) < distance(out));
      CHECK(kinetic_energy(ball) < 1.01 * start);
    }
  }
}

TEST_CASE("speculative contacts: a wall behind has the restitution of its own material, and stops a body if nothing meets it") {
  constexpr double kSpeed = 3.5;  // radii a step; the ball above does not meet the wall itself
  enum class Met { Now, Never, AtItsAddress };
  for (const Met met : {Met::Now, Met::Never, Met::AtItsAddress}) {
    for (const double e : {0.5, 0.8}) {
      const bool is_nested = e == 0.8;  // in a space of its own
      CAPTURE(static_cast<int>(met));
      CAPTURE(e);
      const auto balls = fx::MaterialSelector::between(0, 0), wall = fx::MaterialSelector::between(0, 1);
      EffectsWorld scene({fx::Restitution{1, 0, balls}, fx::Restitution{e, 0, wall}, fx::SpeculativeContacts{}}, 0.01);
      const dSpaceID space = is_nested ? dSimpleSpaceCreate(scene.world.space()) : scene.world.space();
      dGeomID plane = dCreatePlane(space, 0, 0, 1, 0);
      fx::Material of_plane = 1;
      scene.material_of = [&](dGeomID geom) { return geom == plane ? of_plane : 0; };
      const dBodyID low = scene.add_ball(kRadius, kDensity, {0, 0, 2 * kRadius});
      const dBodyID high = scene.add_ball(kRadius, kDensity, {0, 0, 5 * kRadius});
      const dBodyID other = scene.add_ball(kRadius, kDensity, {1, 0, met == Met::Never ? 1 : 1.5 * kRadius});
      throw_body(other, {0, 0, -1});
      if (met == Met::AtItsAddress) {
        scene.step();
        dBodySetPosition(other, 1, 0, 1);
        dGeomDestroy(plane);
        plane = dCreatePlane(space, 0, 0, 1, 0);
        of_plane = 2;
      }
      throw_body(high, {0, 0, -kSpeed * kRadius / 0.01});
      scene.step();
      if (met == Met::Now) {
        CHECK(speed_up(high) == relative(e * kSpeed * kRadius / 0.01).epsilon(1e-3));
      } else {
        CHECK(std::abs(speed_up(high)) < 1e-3);
      }
      CHECK(height_of(low) > 0);
    }
  }
}

TEST_CASE("speculative contacts: a body that is removed between its contacts and the step meets nothing") {
  EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 0.01);
  const dGeomID floor = dCreatePlane(scene.world.space(), 0, 0, 1, 0);
  const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, 1.5 * kRadius});
  throw_body(ball, {0, 0, -2});
  std::array<dContact, 8> contacts{};
  const int count = dCollide(dBodyGetFirstGeom(ball), floor, 8, &contacts[0].geom, sizeof(dContact));
  REQUIRE(count == 1);
  scene.effects.set_up_contacts(std::span(contacts).first(1), 0, 0);
  scene.effects.remove_body(ball);
  scene.effects.apply_forces();
  dWorldQuickStep(scene.id(), dReal(0.01));
  CHECK(speed_up(ball) == -2);
  CHECK(height_of(ball) == relative(1.5 * kRadius - 0.02).epsilon(within_rounding(1e-14)));
}

TEST_CASE("speculative contacts: a heavy body that drives a light one into the end of a tube gains no energy") {
  Random random(1);
  for (int draw = 0; draw < 20; ++draw) {
    CAPTURE(draw);
    EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 0.01);
    dWorldSetQuickStepNumIterations(scene.id(), 60);
    const dSpaceID space = scene.world.space();
    scene.world.add_plane();
    const auto half = dReal(1.5 * kRadius);
    for (const dReal side : {dReal(-1), dReal(1)}) dCreatePlane(space, side, 0, 0, -half), dCreatePlane(space, 0, side, 0, -half);
    const double exponent = draw % 2 == 0 ? 2 : 8, gap = random.uniform(0, 1) * kRadius;
    const Vec axes = {kRadius, 0.8 * kRadius, 0.6 * kRadius};
    const dBodyID light = scene.add_body(axes, exponent, kDensity, {0, 0, 1.75 * kRadius + gap});
    const dBodyID heavy = scene.add_body(axes, exponent, 10 * kDensity, {random.uniform(-0.2, 0.2) * kRadius, 0, 6 * kRadius});
    for (const dBodyID body : {light, heavy}) {
      random.turn(dBodyGetFirstGeom(body));
      dBodySetGyroscopicMode(body, 0);
    }
    throw_body(heavy, {0, 0, -kRadius / 0.01});
    const double start = kinetic_energy(heavy);
    for (int step = 0; step < 12; ++step) {
      scene.step();
      CHECK(kinetic_energy(light) + kinetic_energy(heavy) < 1.01 * start);
      for (const dBodyID body : {light, heavy}) {
        CHECK(height_of(body) > 0);
        for (int axis = 0; axis < 2; ++axis) CHECK(std::abs(dBodyGetPosition(body)[axis]) < half);
      }
    }
  }
}

TEST_CASE(
    "speculative contacts: a ball joint with ERP 0 ties velocities only: its bodies are moved to touch. A spring or another one "
    "holds them") {
  constexpr double kSoft = 1e-3;  // CFM of a spring
  for (const auto& tie : {std::array{0.0, 0.0}, {0.0, kSoft}, {0.2, 0.0}}) {
    const double erp = tie[0], cfm = tie[1];
    CAPTURE(erp);
    CAPTURE(cfm);
    const double step = 10e-3;
    OnPlane scene({fx::Restitution{0.5, 0, {}}, fx::SpeculativeContacts{}}, step);
    constexpr double kGap = 4e-3;  // m
    const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + kGap});
    const dBodyID image = scene.add_ball(kRadius, kDensity, {1, 0, kRadius + 1});
    const dJointID joint = dJointCreateBall(scene.id(), nullptr);
    dJointAttach(joint, ball, image);
    dJointSetBallAnchor(joint, dReal(0.5), 0, dReal(kRadius + 0.5));
    dJointSetBallParam(joint, dParamERP, dReal(erp));
    dJointSetBallParam(joint, dParamCFM, dReal(cfm));
    for (const dBodyID body : {ball, image}) dBodySetLinearVel(body, 0, 0, -1);
    dGeomMoved(dBodyGetFirstGeom(ball));
    dSpaceCollide(scene.world.space(), &scene, [](void* data, dGeomID o1, dGeomID o2) {
      std::array<dContact, 1> contact{};
      if (dCollide(o1, o2, 1, &contact[0].geom, sizeof(dContact)) == 0) return;
      static_cast<EffectsWorld*>(data)->effects.set_up_contacts(contact);
    });
    scene.effects.apply_forces();
    CHECK(height_of(ball) == relative(kRadius + (erp > 0 || cfm > 0 ? kGap : 0)).epsilon(within_rounding(1e-9, 1000)));
  }
}

TEST_CASE("speculative contacts: a bounce violates a joint no more than without them") {
  // Two balls on the ends of a fixed joint fall on a plane. Returns the largest error of their distance, m.
  const auto error_of = [](double restitution, double step, double angle, bool is_speculative) {
    std::vector<fx::Effect> list = {earth(), fx::Restitution{restitution, 0, {}}};
    if (is_speculative) list.emplace_back(fx::SpeculativeContacts{});
    OnPlane scene(list, step);
    dWorldSetQuickStepNumIterations(scene.id(), 100);
    constexpr double kDistance = 4 * kRadius;
    const dBodyID low = scene.add_ball(kRadius, kDensity, {0, 0, 0.1});
    const dBodyID high = scene.add_ball(kRadius, kDensity, {kDistance * std::cos(angle), 0, 0.1 + kDistance * std::sin(angle)});
    const dJointID joint = dJointCreateFixed(scene.id(), nullptr);
    dJointAttach(joint, low, high);
    dJointSetFixed(joint);
    double worst = 0;
    scene.run_until(0.25, [&] {
      const double distance = norm(to_vec(dBodyGetPosition(high)) - to_vec(dBodyGetPosition(low)));
      worst = std::max(worst, std::abs(distance - kDistance));
      return false;
    });
    return worst;
  };
  for (const double restitution : {0.3, 0.5}) {
    for (const double step : {0.5e-3, 1e-3, 2e-3, 4e-3}) {
      CAPTURE(restitution);
      CAPTURE(step);
      double plain = 0;
      double speculative = 0;
      for (int k = 0; k < 20; ++k) {
        plain = std::max(plain, error_of(restitution, step, 0.05 + 0.07 * k, false));
        speculative = std::max(speculative, error_of(restitution, step, 0.05 + 0.07 * k, true));
      }
      CHECK(speculative <= 1.1 * plain);
    }
  }
}

TEST_CASE("speculative contacts: bodies without a geom of ours are refused") {
  EffectsWorld scene({fx::SpeculativeContacts{}}, 1e-2);
  const dBodyID body = dBodyCreate(scene.id());
  CHECK_THROWS_WITH_AS(scene.effects.add_body(body), doctest::Contains("no geom made by snCreate"), std::invalid_argument);
}

TEST_CASE(
    "speculative contacts: a body is in one Effects with restitution, and leaves it by its end, by remove_body and as a copy") {
  EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 1e-2);
  const auto make = [] { return fx::Effects({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 1e-2); };
  auto other = std::make_unique<fx::Effects>(make());
  fx::Effects without({fx::SpeculativeContacts{}}, 1e-2);
  const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, 0});
  scene.effects.add_body(ball);
  without.add_body(ball);
  CHECK_THROWS_WITH_AS(other->add_body(ball), doctest::Contains("one such Effects for each world"), std::invalid_argument);
  const dBodyID image = dBodyCreate(scene.id());
  dGeomSetBody(snGeomCopy(scene.world.space(), dBodyGetFirstGeom(ball)), image);
  CHECK_NOTHROW(other->add_body(image));
  scene.effects.remove_body(ball);
  CHECK_NOTHROW(other->add_body(ball));
  other.reset();
  CHECK_NOTHROW(scene.effects.add_body(ball));
}
