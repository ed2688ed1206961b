// What a contact of the stepper may carry: all of dContact.surface.
#include <doctest/doctest.h>

#include "stepper/stepper_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

constexpr double kStep = 0.01;  // s

/// A ball of radius 0.05 m that touches a floor without geoms: the program makes the contact, with the ball as body 1.
struct BallOnFloor {
  BallOnFloor() : ball(scene.add_ball(0.05, {0, 0, 0.05})), weight(mass_of(ball) * kGravity) {
    contact.surface.mode = dContactApprox1 | dContactFDir1;
    contact.geom.normal[2] = 1;
    contact.fdir1[0] = 1;
  }

  void run(double time, const Vec& force = {}) {
    for (int i = 0; i < std::lround(time / kStep); ++i) {
      for (std::size_t k = 0; k < 2; ++k) contact.geom.pos[k] = dBodyGetPosition(ball)[k];
      contact.geom.depth = dReal(0.05) - dBodyGetPosition(ball)[2];
      dBodyAddForce(ball, dReal(force[0]), dReal(force[1]), dReal(force[2]));
      REQUIRE(snStepperAddContact(scene.stepper, &contact, ball, nullptr) == 1);
      REQUIRE(snStepperStep(scene.stepper, dReal(kStep)) == dReal(kStep));
    }
  }

  /// m/s, of the ball where it touches.
  Vec slip() const {
    const Vec v = velocity_of(ball);
    const Vec w = spin_of(ball);
    const double radius = place_of(ball)[2];  // to the place of the contact
    return {v[0] - radius * w[1], v[1] + radius * w[0], v[2]};
  }

  StepperWorld scene{kStep};
  dBodyID ball;
  double weight;  // N
  dContact contact{};
};

}  // namespace

TEST_CASE_FIXTURE(BallOnFloor, "friction without Approx1 is a force") {
  contact.surface.mode &= ~dContactApprox1;
  contact.surface.mu = dReal(0.7);  // N
  set_velocity(ball, {5, 0, 0});
  run(0.1);
  CHECK(velocity_of(ball)[0] == relative(5 - 0.1 * 0.7 / mass_of(ball)).epsilon(1e-6));
}

TEST_CASE_FIXTURE(BallOnFloor, "two coefficients of friction: the force in their ellipse that dissipates most") {
  contact.surface.mode |= dContactMu2;
  contact.surface.mu = dReal(0.2);
  contact.surface.mu2 = dReal(0.6);
  run(0.5);
  set_velocity(ball, {500, 500, 0});  // so fast that its direction hardly changes
  run(0.1);
  const double length = std::hypot(0.2, 0.6);
  CHECK(500 - velocity_of(ball)[0] == relative(0.1 * kGravity * 0.2 * 0.2 / length).epsilon(2e-3));
  CHECK(500 - velocity_of(ball)[1] == relative(0.1 * kGravity * 0.6 * 0.6 / length).epsilon(2e-3));
}

TEST_CASE_FIXTURE(BallOnFloor, "friction without limit lets nothing slip, and leaves the other direction alone") {
  contact.surface.mode |= dContactMu2;
  contact.surface.mu = dInfinity;
  contact.surface.mu2 = 0;
  set_velocity(ball, {1, 1, 0});
  run(0.2, {100, 0, 0});
  CHECK(std::abs(slip()[0]) < 1e-6 * norm(velocity_of(ball)));
  CHECK(slip()[1] == relative(1).epsilon(1e-6));
}

TEST_CASE_FIXTURE(BallOnFloor, "surfaces move") {
  contact.surface.mode |= dContactMotion1 | dContactMotion2;
  contact.surface.mu = 1;
  contact.surface.motion1 = dReal(0.3);
  contact.surface.motion2 = dReal(-0.2);
  run(0.5);
  CHECK(slip()[0] == relative(0.3).epsilon(1e-6));
  CHECK(slip()[1] == relative(-0.2).epsilon(1e-6));
  contact.surface.mode |= dContactMotionN;
  contact.surface.motionN = dReal(0.1);
  run(kStep);
  CHECK(velocity_of(ball)[2] > 0.09);
}

TEST_CASE("a belt moves bodies as it does in quickstep, in both orders of the bodies, with and without fdir1") {
  for (const bool is_first : {true, false}) {
    for (const int direction : {0, int{dContactFDir1}}) {
      BallOnFloor on;
      on.contact.surface.mode = dContactApprox1 | dContactMotion1 | dContactMotion2 | direction;
      on.contact.surface.mu = 1;
      on.contact.surface.motion1 = dReal(0.3);
      on.contact.surface.motion2 = dReal(0.1);
      on.contact.geom.normal[2] = is_first ? 1 : -1;
      on.contact.geom.pos[2] = 0;
      const dBodyID other =
          on.scene.world.add(snCreateEllipsoid(on.scene.world.space(), dReal(0.05), dReal(0.05), dReal(0.05)), 1000);
      dBodySetPosition(other, 1, 0, dReal(0.05));
      dContact beside = on.contact;
      beside.geom.pos[0] = 1;
      const dJointID joint = dJointCreateContact(on.scene.world.id(), nullptr, &beside);
      dJointAttach(joint, is_first ? other : nullptr, is_first ? nullptr : other);
      REQUIRE(snStepperAddContact(on.scene.stepper, &on.contact, is_first ? on.ball : nullptr, is_first ? nullptr : on.ball) == 1);
      REQUIRE(snStepperStep(on.scene.stepper, dReal(kStep)) == dReal(kStep));  // quickstep moves the other one
      CHECK(norm(velocity_of(on.ball)) > 0.01);
      CHECK(dot(velocity_of(on.ball), velocity_of(other)) > 0.99 * norm(velocity_of(on.ball)) * norm(velocity_of(other)));
      dJointDestroy(joint);
    }
  }
}

TEST_CASE_FIXTURE(BallOnFloor, "slip is proportional to the force") {
  contact.surface.mode |= dContactSlip1 | dContactRolling;
  contact.surface.mu = 1;
  contact.surface.slip1 = dReal(0.04);  // m/(N s)
  contact.surface.rho = dInfinity;      // it slides without rolling
  run(1, {2, 0, 0});
  CHECK(velocity_of(ball)[0] == relative(0.08).epsilon(1e-6));
}

TEST_CASE_FIXTURE(BallOnFloor, "soft ERP and CFM are the spring and the damper that they are to quickstep") {
  const double stiffness = 1000;  // N/m
  const double damping = 4;       // N s/m
  contact.surface.mode |= dContactSoftERP | dContactSoftCFM;
  contact.surface.soft_erp = dReal(kStep * stiffness / (kStep * stiffness + damping));
  contact.surface.soft_cfm = dReal(1 / (kStep * stiffness + damping));
  run(2);
  CHECK(0.05 - place_of(ball)[2] == relative(weight / stiffness).epsilon(1e-3));
  contact.surface.mode &= ~dContactSoftERP;  // the world's
  dWorldSetERP(scene.world.id(), dReal(0.5));
  run(2);
  const double of_world = 0.5 / (kStep * double{contact.surface.soft_cfm});
  CHECK(0.05 - place_of(ball)[2] == relative(weight / of_world).epsilon(1e-3));
}

TEST_CASE_FIXTURE(BallOnFloor, "soft ERP alone corrects its share of an overlap in a step") {
  dWorldSetGravity(scene.world.id(), 0, 0, 0);
  contact.surface.mode |= dContactSoftERP;
  contact.surface.soft_erp = dReal(0.2);
  dBodySetPosition(ball, 0, 0, dReal(0.049));
  run(kStep);
  CHECK(0.05 - place_of(ball)[2] == relative(0.001 * std::exp(-0.2)).epsilon(3e-3));
  contact.surface.soft_erp = 0;
  const double depth = 0.05 - place_of(ball)[2];
  run(0.1);
  CHECK(0.05 - place_of(ball)[2] == relative(depth).epsilon(1e-6));
}

TEST_CASE_FIXTURE(BallOnFloor, "rolling and spinning resistance brake as their lengths say") {
  contact.surface.mode |= dContactRolling | dContactAxisDep;
  contact.surface.mu = contact.surface.mu2 = 1;
  contact.surface.rho = contact.surface.rho2 = dReal(1e-3);
  contact.surface.rhoN = dReal(2e-3);
  run(0.2);
  set_velocity(ball, {1, 0, 0});
  set_spin(ball, {0, 20, 30});
  run(0.2);
  CHECK(velocity_of(ball)[0] == relative(1 - 0.2 * 5.0 / 7 * kGravity * 1e-3 / 0.05).epsilon(3e-4));
  CHECK(spin_of(ball)[2] == relative(30 - 0.2 * kGravity * 2e-3 / (0.4 * 0.05 * 0.05)).epsilon(1e-3));
  run(10);
  CHECK(norm(velocity_of(ball)) < within_rounding(1e-12));
  CHECK(norm(spin_of(ball)) < within_rounding(1e-10));
}

TEST_CASE("slow impacts do not bounce, and negative thresholds let nothing bounce") {
  for (const auto& [threshold, speed] : {std::pair{0.5, 0.0}, {1.5, -0.1}, {-1.0, -0.1}}) {
    StepperWorld scene(kStep);
    dWorldSetGravity(scene.world.id(), 0, 0, 0);
    scene.surface.mode |= dContactBounce;
    scene.surface.bounce = dReal(0.5);
    scene.surface.bounce_vel = dReal(threshold);
    scene.world.add_plane();
    const dBodyID ball = scene.add_ball(0.05, {0, 0, 0.1});
    set_velocity(ball, {0, 0, -1});
    scene.run(0.2);
    if (speed == 0) {
      CHECK(velocity_of(ball)[2] == relative(0.5).epsilon(1e-6));
    } else {
      CHECK(std::abs(velocity_of(ball)[2]) < within_rounding(1e-9));
    }
  }
}

TEST_CASE("the world's surface layer is not corrected, and its correcting velocity is the largest") {
  StepperWorld scene(kStep);
  dWorldSetGravity(scene.world.id(), 0, 0, 0);
  dWorldSetContactSurfaceLayer(scene.world.id(), dReal(1e-3));
  dWorldSetContactMaxCorrectingVel(scene.world.id(), dReal(1e-3));
  scene.world.add_plane();
  const dBodyID ball = scene.add_ball(0.05, {0, 0, 0.046});
  scene.run(0.1);
  CHECK(place_of(ball)[2] == relative(0.0461).epsilon(1e-4));
  dWorldSetContactMaxCorrectingVel(scene.world.id(), dInfinity);
  scene.run(2);
  CHECK(place_of(ball)[2] == relative(0.049).epsilon(1e-4));
}
