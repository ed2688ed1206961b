// Tests of contacts whose bodies differ from the bodies of their geoms: moving walls and moving surfaces.
#include <doctest/doctest.h>

#include "effects/effects_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

/// Gives the plane z = 0, which stays in place, the velocity of a kinematic body.
dBodyID add_belt(EffectsWorld& scene, const Vec& velocity, const Vec& spin = {0, 0, 0}) {
  const dBodyID belt = dBodyCreate(scene.id());
  dBodySetKinematic(belt);
  dBodySetLinearVel(belt, dReal(velocity[0]), dReal(velocity[1]), dReal(velocity[2]));
  dBodySetAngularVel(belt, dReal(spin[0]), dReal(spin[1]), dReal(spin[2]));
  scene.other_body[dCreatePlane(scene.world.space(), 0, 0, 1, 0)] = belt;
  return belt;
}

/// The body moves with its velocity. The belt's surface stays in place.
void step(EffectsWorld& scene, dBodyID belt) {
  scene.step();
  dBodySetPosition(belt, 0, 0, 0);
}

/// The velocity of a ball after it has hit a plane that moves towards it.
double rebound(const std::vector<fx::Effect>& effects, double approach, double rise) {
  EffectsWorld scene(effects, kStep / 10);
  const dBodyID wall = add_belt(scene, {0, 0, rise});
  const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, kBallRadius + 1e-3});
  dBodySetLinearVel(ball, 0, 0, dReal(-approach));
  for (int i = 0; i < 2000; ++i) {
    scene.step();
    dGeomPlaneSetParams(scene.other_body.begin()->first, 0, 0, 1, dBodyGetPosition(wall)[2]);
  }
  return dBodyGetLinearVel(ball)[2];
}

}  // namespace

TEST_CASE("a puck on a belt has its velocity after v / (mu g), and a wall without velocity does not carry it") {
  constexpr double kSpeed = 0.5;
  for (const double mu : {0.2, 0.5}) {
    EffectsWorld scene({earth(), fx::Friction{mu, {}}}, kStep);
    const dBodyID belt = add_belt(scene, {kSpeed, 0, 0});
    const dBodyID puck = scene.add_body({0.1, 0.1, 0.02}, 20, 1000, {0, 0, 0.02});
    double time = 0;
    while (dBodyGetLinearVel(puck)[0] < 0.999 * kSpeed && time < 2) {
      step(scene, belt);
      time += kStep;
    }
    CHECK(time == relative(kSpeed / (mu * kGravity)).epsilon(0.01));
    for (int i = 0; i < 500; ++i) step(scene, belt);
    CHECK(double{dBodyGetLinearVel(puck)[0]} == relative(kSpeed).epsilon(1e-3));
  }
}

TEST_CASE("a ball on a belt ends rolling at 2/7 of the belt's velocity") {
  for (const double length : {kStep, 1e-3, 1e-2, 5e-2}) {  // s; the long steps with contacts before overlap
    CAPTURE(length);
    std::vector<fx::Effect> list = {earth(), fx::Friction{0.3, {}}};
    if (length > kStep) list.emplace_back(fx::SpeculativeContacts{});
    EffectsWorld scene(list, length);
    const dBodyID belt = add_belt(scene, {0, 0.7, 0});
    const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, kBallRadius});
    for (int i = 0; i < 2000; ++i) step(scene, belt);
    CHECK(double{dBodyGetLinearVel(ball)[1]} == relative(2.0 / 7 * 0.7).epsilon(1e-3));
    CHECK(double{dBodyGetAngularVel(ball)[0]} == relative((0.7 - 0.2) / kBallRadius).epsilon(1e-3));
    CHECK(double{dBodyGetPosition(ball)[2]} == relative(kBallRadius).epsilon(1e-3));
  }
}

TEST_CASE("spinning resistance sets a ball at the axis of a turntable spinning") {
  EffectsWorld scene({earth(), fx::Friction{0.3, {}}, fx::RollingResistance{0, 1e-3, {}}}, kStep);
  const dBodyID table = add_belt(scene, {0, 0, 0}, {0, 0, 3});
  const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, kBallRadius});
  // The torque is 1e-3 m times the weight, and the moment of inertia 2/5 m r^2.
  const double time = 3 * 0.4 * kBallRadius * kBallRadius / (1e-3 * kGravity);
  const int half = static_cast<int>(0.5 * time / kStep);
  for (int i = 0; i < half; ++i) step(scene, table);
  CHECK(double{dBodyGetAngularVel(ball)[2]} == relative(1.5).epsilon(0.02));
  for (int i = 0; i < 2 * half; ++i) step(scene, table);
  CHECK(double{dBodyGetAngularVel(ball)[2]} == relative(3).epsilon(1e-3));
}

TEST_CASE("restitution applies to the velocity relative to the wall") {
  constexpr double kApproach = 0.4;
  constexpr double kRise = 0.3;
  const double bounce = kRise + 0.6 * (kApproach + kRise);
  CHECK(rebound({fx::Restitution{0.6, 0, {}}}, kApproach, kRise) == relative(bounce).epsilon(1e-5));
  CHECK(rebound({fx::Hertz{1e7, 0.3, 0.6, {}}}, kApproach, kRise) == relative(bounce).epsilon(0.01));
  const double mass = 4.0 / 3 * std::numbers::pi * std::pow(kBallRadius, 3) * 1000;
  CHECK(rebound({fx::Compliance{1e4 * mass, 0, {}}}, kApproach, kRise) == relative(kRise + kApproach + kRise).epsilon(0.01));
}

TEST_CASE("sides with the bodies of the geoms give the same contacts as materials alone") {
  EffectsWorld scene({earth(), fx::Friction{0.3, {}}, fx::RollingResistance{1e-3, 1e-3, {}}, fx::Hertz{1e7, 0.3, 0.6, {}}}, kStep);
  const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, 0});
  const dBodyID other = scene.add_ball(kBallRadius, 1000, {0.06, 0.07, 0});
  dBodySetLinearVel(ball, 1, dReal(0.3), 0);
  dBodySetAngularVel(other, 1, 2, 3);
  std::array<dContact, 1> a{};
  REQUIRE(dCollide(dBodyGetFirstGeom(ball), dBodyGetFirstGeom(other), 1, &a[0].geom, sizeof(dContact)) == 1);
  std::array<dContact, 1> b = a;
  CHECK(scene.effects.set_up_contacts(a) == 1);
  CHECK(scene.effects.set_up_contacts(b, {0, dGeomGetBody(b[0].geom.g1)}, {0, dGeomGetBody(b[0].geom.g2)}) == 1);
  CHECK(a[0].surface.motionN == b[0].surface.motionN);
  CHECK(a[0].surface.rho == b[0].surface.rho);
  CHECK(std::equal(a[0].fdir1, a[0].fdir1 + 3, b[0].fdir1));
}
