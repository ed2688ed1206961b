// Joints of ODE whose bodies the stepper moves, beside closed forms.
#include <doctest/doctest.h>

#include <limits>

#include "stepper/stepper_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

/// Which of the two bodies of a joint is the world.
void attach(dJointID joint, dBodyID body, bool is_reversed) {
  dJointAttach(joint, is_reversed ? nullptr : body, is_reversed ? body : nullptr);
}

/// A hinge along y at a place.
dJointID hinge_at(const StepperWorld& scene, dBodyID body1, dBodyID body2, const Vec& place) {
  const dJointID hinge = dJointCreateHinge(scene.world.id(), nullptr);
  dJointAttach(hinge, body1, body2);
  dJointSetHingeAnchor(hinge, dReal(place[0]), dReal(place[1]), dReal(place[2]));
  dJointSetHingeAxis(hinge, 0, 1, 0);
  return hinge;
}

dJointID slider_along(const StepperWorld& scene, dBodyID body, const Vec& axis, bool is_reversed) {
  const dJointID slider = dJointCreateSlider(scene.world.id(), nullptr);
  attach(slider, body, is_reversed);
  dJointSetSliderAxis(slider, dReal(axis[0]), dReal(axis[1]), dReal(axis[2]));
  return slider;
}

/// kg m^2; about the y axis through its centre.
double inertia_of(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  return double{mass.I[5]};
}

}  // namespace

TEST_CASE("a pendulum on a hinge has the period of the elliptic integral and keeps its energy") {
  for (const double step : {0.002, 0.01}) {
    for (const bool is_reversed : {false, true}) {
      StepperWorld scene(step);
      constexpr double kArm = 0.2;
      constexpr double kAmplitude = 0.3;
      const dBodyID brick = scene.add_brick(8, 1000, {kArm * std::sin(kAmplitude), 0, -kArm * std::cos(kAmplitude)});
      dQuaternion q;
      dQFromAxisAndAngle(q, 0, 1, 0, dReal(-kAmplitude));
      dBodySetQuaternion(brick, q);
      is_reversed ? hinge_at(scene, nullptr, brick, {0, 0, 0}) : hinge_at(scene, brick, nullptr, {0, 0, 0});
      const double m = mass_of(brick);
      const double slowness = std::sqrt((inertia_of(brick) + m * kArm * kArm) / (m * kGravity * kArm));
      const double period = 4 * slowness * std::comp_ellint_1(std::sin(kAmplitude / 2));
      double first = 0;
      double last = 0;
      int periods = -1;
      double farthest = 0;
      for (int i = 0; i * step < 20; ++i) {
        const double before = place_of(brick)[0];
        scene.step();
        const double x = place_of(brick)[0];
        if (i * step > 18) farthest = std::max(farthest, x);
        CHECK(std::abs(norm(place_of(brick)) - kArm) < 1e-4);
        if (before >= 0 || x < 0) continue;
        last = step * (i + 1 - x / (x - before));
        if (++periods == 0) first = last;
      }
      CHECK(periods > 15);
      CHECK((last - first) / periods == relative(period).epsilon(2e-4));
      CHECK(farthest == relative(kArm * std::sin(kAmplitude)).epsilon(8e-4));
    }
  }
}

TEST_CASE("a body on a ball joint keeps its energy and its angular momentum about the vertical") {
  for (const double step : {0.002, 0.01}) {
    StepperWorld scene(step);
    const dBodyID top = scene.add_brick(8, 1000, {0.15, 0, 0});
    set_velocity(top, {0, 0.6, 0});
    set_spin(top, {0, 0, 4});
    const dJointID ball = dJointCreateBall(scene.world.id(), nullptr);
    dJointAttach(ball, top, nullptr);
    dJointSetBallAnchor(ball, 0, 0, 0);

    const double before = energy(top);
    const double scale = kinetic_energy(top);
    scene.run(5);
    CHECK(std::abs(energy(top) - before) / scale < 5e-3);
  }
}

TEST_CASE("a motor turns as its torque says, holds what is below its stall torque, and lets go what is above") {
  for (const bool is_reversed : {false, true}) {
    StepperWorld scene(0.01);
    const dBodyID rotor = scene.add_brick(8, 1000, {0, 0, 1});
    const dJointID motor = is_reversed ? hinge_at(scene, nullptr, rotor, {0, 0, 1}) : hinge_at(scene, rotor, nullptr, {0, 0, 1});
    dJointSetHingeParam(motor, dParamVel, 5);
    dJointSetHingeParam(motor, dParamFMax, dReal(0.01));
    scene.run(0.5);
    CHECK(spin_of(rotor)[1] == relative(0.5 * 0.01 / inertia_of(rotor)).epsilon(within_rounding(1e-9)));
    dJointSetHingeParam(motor, dParamFMax, 10);
    scene.run(0.5);
    CHECK(spin_of(rotor)[1] == relative(5).epsilon(within_rounding(1e-9)));
    for (const double part : {0.99, 1.01}) {
      const dBodyID arm = scene.add_brick(8, 1000, {0.3, 0, 1});
      const dJointID held = hinge_at(scene, arm, nullptr, {0.1, 0, 1});
      const double weight = mass_of(arm) * kGravity * 0.2;
      dJointSetHingeParam(held, dParamFMax, dReal(part * weight));
      scene.run(1);
      const double fallen = 0.5 * 0.2 * 0.01 * weight / (inertia_of(arm) + mass_of(arm) * 0.04);
      CHECK(1 - place_of(arm)[2] == doctest::Approx(part < 1 ? fallen : 0).epsilon(0.02));
      REQUIRE(snStepperRemoveBody(scene.stepper, arm) == 1);
      dGeomDestroy(dBodyGetFirstGeom(arm));
      dBodyDestroy(arm);
    }
  }
}

TEST_CASE("a slider falls along its axis as free, with a motor by what is left, and rests at its stop") {
  for (const bool is_reversed : {false, true}) {
    StepperWorld scene(0.01);
    const double c = std::sqrt(0.5);
    const dBodyID brick = scene.add_brick(8, 1000, {0, 0, 0});
    const dJointID slider = slider_along(scene, brick, {c, 0, c}, is_reversed);
    scene.run(0.5);
    CHECK(velocity_of(brick)[0] == relative(-0.5 * kGravity * 0.5).epsilon(1e-6));
    CHECK(velocity_of(brick)[2] == relative(-0.5 * kGravity * 0.5).epsilon(1e-6));
    const double before = velocity_of(brick)[2];
    dJointSetSliderParam(slider, dParamFMax, dReal(0.5 * mass_of(brick) * kGravity * c));
    scene.run(0.1);
    CHECK(velocity_of(brick)[2] - before == relative(-0.5 * kGravity * 0.5 * 0.1).epsilon(within_rounding(1e-6)));
    const double stop = double{dJointGetSliderPosition(slider)} + (is_reversed ? 1 : -1);
    dJointSetSliderParam(slider, is_reversed ? dParamHiStop : dParamLoStop, dReal(stop));
    scene.run(2);
    CHECK(double{dJointGetSliderPosition(slider)} == relative(stop).epsilon(1e-4));
    CHECK(norm(velocity_of(brick)) < 1e-6);
    CHECK(norm(spin_of(brick)) < 1e-6);
  }
}

TEST_CASE("a pendulum rests at the stop of its hinge, and the joint tells its force") {
  for (const double step : {0.002, 0.01, 0.033}) {
    StepperWorld scene(step);
    const dBodyID brick = scene.add_brick(8, 1000, {0.2, 0, 0});
    const dJointID hinge = hinge_at(scene, brick, nullptr, {0, 0, 0});
    dJointSetHingeParam(hinge, dParamLoStop, dReal(-0.5));
    dJointSetHingeParam(hinge, dParamHiStop, dReal(0.5));
    dJointFeedback told{};
    dJointSetFeedback(hinge, &told);
    scene.run(2);
    CHECK(double{dJointGetHingeAngle(hinge)} == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(norm(spin_of(brick)) < 1e-6);
    const double weight = mass_of(brick) * kGravity;
    CHECK(double{told.f1[2]} == relative(weight).epsilon(1e-4));
    CHECK(std::abs(double{told.t1[1]}) < 1e-4 * weight);
    CHECK(double{told.t2[1]} == relative(weight * 0.2 * std::cos(0.5)).epsilon(1e-3));
  }
}

TEST_CASE("a beam of bricks that are fixed to one another and to the world stays where it is") {
  StepperWorld scene(0.01);
  std::array<dBodyID, 6> beam{};
  std::array<dJointFeedback, 6> told{};
  for (std::size_t i = 0; i < beam.size(); ++i) {
    beam[i] = scene.add_brick(8, 1000, {0.2 * double(i), 0, 0});
    const dJointID joint = dJointCreateFixed(scene.world.id(), nullptr);
    dJointAttach(joint, beam[i], i == 0 ? nullptr : beam[i - 1]);
    dJointSetFixed(joint);
    dJointSetFeedback(joint, &told[i]);
  }
  scene.run(3);
  CHECK(std::abs(place_of(beam.back())[2]) < 5e-3);  // of 1.1 m; quickstep's swings by 0.3 m
  CHECK(norm(velocity_of(beam.back())) < 1e-6);
  CHECK(double{told[0].f1[2]} == relative(6 * mass_of(beam[0]) * kGravity).epsilon(1e-4));
}

TEST_CASE("a body that is removed and added again has its joints taken anew, as after it was moved and fixed there") {
  for (const bool is_same : {false, true}) {  // the joint; else another one, which may have its address
    StepperWorld scene(0.01);
    dWorldSetGravity(scene.world.id(), 0, 0, 0);
    const dBodyID one = scene.add_brick(8, 1000, {0, 0, 0});
    const dBodyID two = scene.add_brick(8, 1000, {0.3, 0, 0});
    dJointID joint = nullptr;
    for (const Vec& at : {Vec{0.3, 0, 0}, Vec{0.5, 0.2, 0.1}}) {
      dBodySetPosition(two, dReal(at[0]), dReal(at[1]), dReal(at[2]));
      if (joint != nullptr && !is_same) dJointDestroy(joint);
      if (joint == nullptr || !is_same) joint = dJointCreateFixed(scene.world.id(), nullptr);
      dJointAttach(joint, one, two);
      dJointSetFixed(joint);
      REQUIRE(snStepperRemoveBody(scene.stepper, two) == 1);
      REQUIRE(snStepperAddBody(scene.stepper, two) == 1);
      scene.run(0.2);
      CHECK(norm(place_of(two) - place_of(one) - at) < 1e-12);
    }
  }
}

TEST_CASE("two shafts that a universal joint ties turn as Cardan's angles say") {
  constexpr double kBend = 0.5;
  for (const double step : {0.002, 0.01}) {
    StepperWorld scene(step);
    dWorldSetGravity(scene.world.id(), 0, 0, 0);
    const dBodyID first = scene.add_brick(8, 1000, {-0.3, 0, 0});
    const dBodyID second = scene.add_brick(8, 1000, {0.3 * std::cos(kBend), 0.3 * std::sin(kBend), 0});
    const auto shaft = [&](dBodyID body, double bend) {
      const dJointID hinge = hinge_at(scene, body, nullptr, place_of(body));
      dJointSetHingeAxis(hinge, dReal(std::cos(bend)), dReal(std::sin(bend)), 0);
      return hinge;
    };
    const dJointID drive = shaft(first, 0);
    const dJointID driven = shaft(second, kBend);
    const dJointID cross = dJointCreateUniversal(scene.world.id(), nullptr);
    dJointAttach(cross, first, second);
    dJointSetUniversalAnchor(cross, 0, 0, 0);
    dJointSetUniversalAxis1(cross, 0, 0, 1);
    dJointSetUniversalAxis2(cross, dReal(-std::sin(kBend)), dReal(std::cos(kBend)), 0);
    dJointSetHingeParam(drive, dParamVel, 3);
    dJointSetHingeParam(drive, dParamFMax, 100);
    for (int i = 0; i * step < 2; ++i) {
      scene.step();
      const double turned = dJointGetHingeAngle(drive);
      const double right = std::atan2(std::sin(turned) * std::cos(kBend), std::cos(turned));
      const double other = std::atan2(std::sin(turned), std::cos(turned) * std::cos(kBend));
      const double is = dJointGetHingeAngle(driven);
      CHECK(std::min(std::abs(std::sin(is - right)), std::abs(std::sin(is - other))) < 1e-3);
    }
    CHECK(spin_of(first)[0] == relative(3).epsilon(5e-5));
  }
}

TEST_CASE("a body on a universal joint rests at the stops at which it rests by quickstep") {
  for (const bool is_reversed : {false, true}) {
    std::array<Vec, 2> places{};
    for (const bool is_ours : {false, true}) {
      StepperWorld scene(0.005);
      dWorldSetGravity(scene.world.id(), 3, 2, dReal(-kGravity));
      const dBodyID brick = scene.add_brick(8, 1000, {0.2, 0.05, 0});
      if (!is_ours) REQUIRE(snStepperRemoveBody(scene.stepper, brick) == 1);
      dBodySetAngularDamping(brick, dReal(0.02));
      const dJointID joint = dJointCreateUniversal(scene.world.id(), nullptr);
      attach(joint, brick, is_reversed);
      dJointSetUniversalAnchor(joint, 0, 0, 0);
      dJointSetUniversalAxis1(joint, 0, 0, 1);
      dJointSetUniversalAxis2(joint, 0, 1, 0);
      dJointSetUniversalParam(joint, dParamLoStop1, dReal(-0.3));
      dJointSetUniversalParam(joint, dParamHiStop1, dReal(0.7));
      dJointSetUniversalParam(joint, dParamLoStop2, dReal(-0.1));
      dJointSetUniversalParam(joint, dParamHiStop2, dReal(0.5));
      scene.run(6);
      places[is_ours ? 1 : 0] = place_of(brick);
    }
    CHECK(norm(places[1] - places[0]) < 3e-3);  // the stops of quickstep give way
    CHECK(norm(places[0] - Vec{0.2, 0.05, 0}) > 0.05);
  }
}

TEST_CASE("a chain carries a hundred times the mass of a link, and hangs still") {
  for (const double step : {0.002, 0.01, 0.02}) {
    StepperWorld scene(step);
    std::array<dBodyID, 10> chain{};
    for (std::size_t i = 0; i < chain.size(); ++i) {
      chain[i] = scene.add_brick(8, i + 1 == chain.size() ? 1e5 : 1000, {0, 0, -0.15 * double(i)});
      hinge_at(scene, chain[i], i == 0 ? nullptr : chain[i - 1], {0, 0, 0.075 - 0.15 * double(i)});
    }
    scene.run(3);
    CHECK_MESSAGE(std::abs(place_of(chain.back())[2] + 0.15 * 9) < 2e-3, place_of(chain.back())[2]);
    CHECK(norm(velocity_of(chain.back())) < 1e-4);
  }
}

TEST_CASE("bodies are free once their joint is gone or disabled, and a body that is removed takes its joint along") {
  StepperWorld scene(0.01);
  std::array<dBodyID, 3> bricks{};
  std::array<dJointID, 3> joints{};
  for (std::size_t i = 0; i < 3; ++i) {
    bricks[i] = scene.add_brick(8, 1000, {double(i), 0, 0});
    joints[i] = hinge_at(scene, bricks[i], nullptr, {double(i), 0, 0});
  }
  scene.run(0.1);
  for (const dBodyID brick : bricks) CHECK(std::abs(velocity_of(brick)[2]) < 1e-9);
  dJointDestroy(joints[0]);
  dJointDisable(joints[1]);
  REQUIRE(snStepperRemoveBody(scene.stepper, bricks[2]) == 1);
  dGeomDestroy(dBodyGetFirstGeom(bricks[2]));
  dBodyDestroy(bricks[2]);
  scene.run(0.1);
  for (int i = 0; i < 2; ++i) CHECK(velocity_of(bricks[std::size_t(i)])[2] == doctest::Approx(-kGravity * 0.1));
  dJointEnable(joints[1]);
  scene.run(1);
  CHECK(place_of(bricks[1])[2] == doctest::Approx(0).epsilon(1e-4));
  dJointSetHingeParam(joints[1], dParamVel, std::numeric_limits<dReal>::quiet_NaN());
  CHECK(snStepperStep(scene.stepper, dReal(0.01)) < 0);
  CHECK(refused_with("dParamVel of a joint = nan"));
}

TEST_CASE(
    "a joint that bounces at its stop, or to a body that was not added, is quickstep's, and stays when it is solved here again") {
  for (const bool bounces : {true, false}) {
    StepperWorld scene(0.005);
    const dBodyID brick = scene.add_brick(8, 1000, {0.2, 0, 0});
    const dBodyID other = bounces ? nullptr : dBodyCreate(scene.world.id());
    if (other != nullptr) dBodySetKinematic(other);
    const dJointID hinge = hinge_at(scene, brick, other, {0, 0, 0});
    dJointSetHingeParam(hinge, dParamHiStop, dReal(0.5));
    if (bounces) dJointSetHingeParam(hinge, dParamBounce, 1);
    scene.run(3);
    if (bounces) CHECK(norm(spin_of(brick)) > 0.1);
    if (!bounces) CHECK(double{dJointGetHingeAngle(hinge)} == doctest::Approx(0.5).epsilon(1e-3));
    dJointSetHingeParam(hinge, dParamBounce, 0);
    if (other != nullptr) REQUIRE(snStepperAddBody(scene.stepper, other) == 1);
    scene.run(2);
    CHECK(double{dJointGetHingeAngle(hinge)} == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(norm(spin_of(brick)) < 1e-6);
  }
}

TEST_CASE("a hinge whose axis a program sets anew between two steps turns about that axis from then on") {
  StepperWorld scene(0.005);
  dWorldSetGravity(scene.world.id(), 0, 0, 0);
  const dBodyID brick = scene.add_brick(8, 1000, {0, 0, 0});
  const dJointID hinge = hinge_at(scene, brick, nullptr, {0, 0, 0});
  scene.run(0.1);
  for (const Vec& axis : {Vec{1, 0, 0}, Vec{0, 0, 1}, Vec{0, 1, 0}}) {
    dJointSetHingeAxis(hinge, dReal(axis[0]), dReal(axis[1]), dReal(axis[2]));
    set_spin(brick, {1, 2, 3});
    scene.run(0.2);
    CHECK(norm(spin_of(brick)) == doctest::Approx(dot(Vec{1, 2, 3}, axis)).epsilon(0.5));
    CHECK(norm(spin_of(brick) - dot(spin_of(brick), axis) * axis) < 1e-6);
  }
}

TEST_CASE("bodies that joints tie fall asleep and wake together") {
  OnFloor scene(0.01);
  scene.let_sleep();
  std::array<dBodyID, 4> chain{};
  for (std::size_t i = 0; i < 4; ++i) {
    chain[i] = scene.add_brick(8, 1000, {0.21 * double(i), 0, 0.05});
    if (i > 0) hinge_at(scene, chain[i - 1], chain[i], {0.21 * double(i) - 0.105, 0, 0.05});
  }
  scene.run(2);
  for (const dBodyID body : chain) CHECK(dBodyIsEnabled(body) == 0);
  dBodyEnable(chain.back());
  scene.step();
  for (const dBodyID body : chain) CHECK(dBodyIsEnabled(body) == 1);
}

TEST_CASE("a paddle turns at the velocity of its motor in a heap of grains") {
  OnFloor scene(0.004);
  for (const double side : {-1, 1}) {
    dCreatePlane(scene.world.space(), dReal(side), 0, 0, dReal(-0.5));
    dCreatePlane(scene.world.space(), 0, dReal(side), 0, dReal(-0.5));
  }
  const dBodyID paddle =
      scene.add(snCreateSuperellipsoid(scene.world.space(), dReal(0.2), dReal(0.02), dReal(0.08), 8, 8), 2000, {0, 0, 0.09});
  const dJointID hinge = hinge_at(scene, paddle, nullptr, {0, 0, 0.09});
  dJointSetHingeAxis(hinge, 0, 0, 1);
  dJointSetHingeParam(hinge, dParamVel, 2);
  dJointSetHingeParam(hinge, dParamFMax, 500);
  Random random(7);
  for (int i = 0; i < 30; ++i) {
    const dGeomID geom = snCreateSuperellipsoid(scene.world.space(), dReal(0.05), dReal(0.04), dReal(0.03), 4, 4);
    const int row = i / 4 % 4;
    const int layer = i / 16;
    scene.add(geom, 1300, {-0.2 + 0.13 * (i % 4), -0.2 + 0.13 * row, 0.25 + 0.12 * layer});
    random.turn(geom);
  }
  scene.run(2);
  CHECK(norm(place_of(paddle) - Vec{0, 0, dReal(0.09)}) < 1e-4);
  CHECK(spin_of(paddle)[2] == doctest::Approx(2).epsilon(1e-3));
}
