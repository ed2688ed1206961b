// Contacts before overlap with each effect: closed forms at long steps, and no force before touch.
#include <doctest/doctest.h>

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
  OdeSession session;
  EffectsWorld scene(list, step);
  scene.world.add_plane();
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
        OdeSession session;
        EffectsWorld scene({earth(), fx::Restitution{e, 0.05, {}}, fx::SpeculativeContacts{}}, step);
        scene.world.add_plane();
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
        OdeSession session;
        EffectsWorld scene({fx::Restitution{0.6, 0, {}}, fx::MaxCorrectingVelocity{0.05}, fx::SpeculativeContacts{}}, step);
        dWorldSetCFM(scene.id(), 0);
        place(dCreateBox(scene.world.space(), 1, 1, dReal(0.01)), {0, 0, -0.005});
        const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + part * step * speed});
        dBodySetLinearVel(ball, 0, 0, dReal(-speed));
        dGeomMoved(dBodyGetFirstGeom(ball));
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
    OdeSession session;
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

TEST_CASE("speculative contacts: Newton's cradle passes the velocity on") {
  for (const double step : {1e-3, 5e-3, 20e-3}) {
    for (const double e : {0.9, 1.0}) {
      CAPTURE(step);
      CAPTURE(e);
      OdeSession session;
      EffectsWorld scene({fx::Restitution{e, 0, {}}, fx::SpeculativeContacts{}}, step);
      constexpr double kSpeed = 0.3;  // m/s
      constexpr int kBalls = 5;
      std::vector<dBodyID> balls;
      balls.reserve(kBalls);
      for (int k = 0; k < kBalls; ++k)
        balls.push_back(scene.add_ball(kRadius, kDensity, {0, 0, -2.05 * k * kRadius - (k > 0 ? 0.1 : 0)}));
      dBodySetLinearVel(balls.front(), 0, 0, dReal(-kSpeed));
      scene.run_until(1.5);
      // Each impact passes on the fraction (1 + e) / 2.
      double handed = kSpeed;
      for (std::size_t k = 0; k + 1 < balls.size(); ++k) {
        if (e == 1) CHECK(std::abs(speed_up(balls[k])) < 0.01 * kSpeed);
        handed *= (1 + e) / 2;
      }
      if (e == 1) CHECK(speed_up(balls.back()) == relative(-kSpeed).epsilon(0.01));
      double momentum = 0;
      for (const dBodyID ball : balls) momentum += speed_up(ball);
      CHECK(momentum == relative(-kSpeed).epsilon(within_rounding(1e-9, 100)));
      CHECK(-speed_up(balls.back()) >= 0.99 * handed);
    }
  }
}

TEST_CASE("speculative contacts: no body gains energy at restitution up to 1") {
  for (const double e : {0.7, 1.0}) {
    for (const double step : {1e-3, 5e-3, 20e-3}) {
      for (unsigned seed = 1; seed <= 4; ++seed) {
        CAPTURE(e);
        CAPTURE(step);
        CAPTURE(seed);
        OdeSession session;
        EffectsWorld scene({earth(), fx::Restitution{e, 0, {}}, fx::SpeculativeContacts{}}, step);
        scene.world.add_plane();
        Random random(seed);
        const dGeomID geom = snCreateEllipsoid(scene.world.space(), dReal(0.05), dReal(0.04), dReal(0.02));
        random.turn(geom);
        const dBodyID body = scene.add(geom, kDensity, {0, 0, 0.5});
        // The energy of the parabola through the steps.
        const auto total = [&] {
          const double v = speed_up(body);
          const double ahead = v - kGravity * step / 2;
          return energy(body) + mass_of(body) / 2 * (ahead * ahead - v * v);
        };
        const double start = total();
        double most = 0;
        for (int i = 0; i < 5000; ++i) {
          scene.step();
          most = std::max(most, total());
        }
        CHECK(most < 1.01 * start);
      }
    }
  }
}

// At 10 ms 4 % are lost. A fast body then moves by its whole radius in a step, and often meets two others in one step.
TEST_CASE("speculative contacts: an elastic gas keeps its energy if bodies move by up to half of their radius in a step") {
  for (const double step : {1e-3, 2e-3, 5e-3}) {
    CAPTURE(step);
    OdeSession session;
    EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, step);
    dWorldSetQuickStepNumIterations(scene.id(), 60);
    for (int axis = 0; axis < 3; ++axis) {
      const std::array<double, 3> n = {axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0};
      dCreatePlane(scene.world.space(), dReal(n[0]), dReal(n[1]), dReal(n[2]), 0);
      dCreatePlane(scene.world.space(), dReal(-n[0]), dReal(-n[1]), dReal(-n[2]), dReal(-0.3));
    }
    Random random(8);
    std::vector<dBodyID> balls;
    for (int k = 0; k < 27; ++k) {
      const int column = k % 3, row = k / 3 % 3, layer = k / 9;
      balls.push_back(scene.add_ball(kRadius, kDensity, {0.05 + 0.1 * column, 0.05 + 0.1 * row, 0.05 + 0.1 * layer}));
      const Vec v = random.uniform(0.2, 1) * random.direction();
      dBodySetLinearVel(balls.back(), dReal(v[0]), dReal(v[1]), dReal(v[2]));
      dGeomMoved(dBodyGetFirstGeom(balls.back()));
    }
    const auto total = [&] {
      double sum = 0;
      for (const dBodyID ball : balls) sum += kinetic_energy(ball);
      return sum;
    };
    const double start = total();
    double most = 0;
    for (int k = 0; k * step < 4; ++k) {
      scene.step();
      most = std::max(most, total());
    }
    CHECK(most < 1.01 * start);
    CHECK(total() > 0.99 * start);
    for (const dBodyID ball : balls) {
      for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(dBodyGetPosition(ball)[axis] - 0.15) < 0.15);
    }
  }
}

TEST_CASE("speculative contacts: a sliding ball ends rolling at 5/7 of its velocity") {
  for (const double step : {1e-3, 10e-3, 50e-3}) {
    CAPTURE(step);
    OdeSession session;
    EffectsWorld scene({earth(), fx::Friction{0.3, {}}, fx::SpeculativeContacts{}}, step);
    scene.world.add_plane();
    const dBodyID ball = scene.add_ball(kBallRadius, kDensity, {0, 0, kBallRadius});
    dBodySetLinearVel(ball, 1, 0, 0);
    scene.run_until(1);
    CHECK(dBodyGetLinearVel(ball)[0] == relative(5.0 / 7).epsilon(0.002));
    CHECK(dBodyGetAngularVel(ball)[1] * kBallRadius == relative(5.0 / 7).epsilon(0.002));
    const double rolling = dBodyGetLinearVel(ball)[0];
    scene.run_until(2);
    CHECK(dBodyGetLinearVel(ball)[0] == relative(rolling).epsilon(1e-3));
    CHECK(height_of(ball) == relative(kBallRadius).epsilon(1e-3));
  }
}

TEST_CASE("speculative contacts: rolling resistance stops a ball after 7/10 v^2 r / (rho g)") {
  for (const double step : {1e-3, 10e-3}) {
    CAPTURE(step);
    OdeSession session;
    constexpr double kRolling = 1e-3;  // m
    EffectsWorld scene({earth(), fx::Friction{0.5, {}}, fx::RollingResistance{kRolling, 0, {}}, fx::SpeculativeContacts{}}, step);
    scene.world.add_plane();
    const dBodyID ball = scene.add_ball(kBallRadius, kDensity, {0, 0, kBallRadius});
    dBodySetLinearVel(ball, 1, 0, 0);
    dBodySetAngularVel(ball, 0, dReal(1 / kBallRadius), 0);
    scene.run_until(20, [&] { return std::abs(dBodyGetLinearVel(ball)[0]) < 1e-3; });
    CHECK(dBodyGetPosition(ball)[0] == relative(0.7 * kBallRadius / (kRolling * kGravity)).epsilon(0.02));
  }
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

TEST_CASE("speculative contacts: added bodies lose four fifths of an overlap in a step, and no other pair does") {
  OdeSession session;
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
  OdeSession session;
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
      OdeSession session;
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
  OdeSession session;
  const double step = 10e-3;
  EffectsWorld scene({fx::Friction{0.5, {}}, fx::SpeculativeContacts{}}, step);
  const dBodyID carrier = dBodyCreate(scene.id());
  dBodySetKinematic(carrier);
  dBodySetLinearVel(carrier, 0, 0, -1);
  scene.other_body[dCreatePlane(scene.world.space(), 0, 0, 1, 0)] = carrier;
  const dBodyID ball = scene.add_ball(kRadius, kDensity, {0, 0, kRadius + 1e-3});
  dBodySetLinearVel(ball, 0, 0, -1);
  dGeomMoved(dBodyGetFirstGeom(ball));
  scene.step();
  CHECK(speed_up(ball) == relative(-1).epsilon(1e-6));
}

TEST_CASE("speculative contacts: bodies with restitution come to rest") {
  for (const double step : {2e-3, 10e-3, 30e-3}) {
    CAPTURE(step);
    OdeSession session;
    EffectsWorld scene({earth(), fx::Friction{0.5, {}}, fx::Restitution{0.5, 0, {}}, fx::SpeculativeContacts{}}, step);
    scene.world.add_plane();
    const dGeomID geom = snCreateSuperellipsoid(scene.world.space(), dReal(0.1), dReal(0.07), dReal(0.05), 20, 20);
    const dBodyID brick = scene.add(geom, kDensity, {0, 0, 0.1});
    turn(brick, {1, 1, 0}, 5 * kDegree);
    scene.run_until(4);
    CHECK(height_of(brick) == relative(0.05).epsilon(0.01));
    CHECK(norm(to_vec(dBodyGetLinearVel(brick))) < 0.02 * kGravity * step);
    CHECK(norm(to_vec(dBodyGetAngularVel(brick))) < 0.02 * kGravity * step / 0.05);
  }
}

TEST_CASE("speculative contacts: a bounce violates a joint no more than without them") {
  // Two balls on the ends of a fixed joint fall on a plane. Returns the largest error of their distance, m.
  const auto error_of = [](double step, double angle, bool is_speculative) {
    OdeSession session;
    std::vector<fx::Effect> list = {earth(), fx::Restitution{0.5, 0, {}}};
    if (is_speculative) list.emplace_back(fx::SpeculativeContacts{});
    EffectsWorld scene(list, step);
    dWorldSetQuickStepNumIterations(scene.id(), 100);
    scene.world.add_plane();
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
  for (const double step : {0.25e-3, 1e-3, 4e-3}) {
    CAPTURE(step);
    double plain = 0;
    double speculative = 0;
    for (int k = 0; k < 10; ++k) {
      plain = std::max(plain, error_of(step, 0.05 + 0.14 * k, false));
      speculative = std::max(speculative, error_of(step, 0.05 + 0.14 * k, true));
    }
    CHECK(speculative <= 1.1 * plain);
  }
}

TEST_CASE("speculative contacts: bodies without a geom of ours are refused") {
  OdeSession session;
  EffectsWorld scene({fx::SpeculativeContacts{}}, 1e-2);
  const dBodyID body = dBodyCreate(scene.id());
  CHECK_THROWS_WITH_AS(scene.effects.add_body(body), doctest::Contains("no geom made by snCreate"), std::invalid_argument);
}
