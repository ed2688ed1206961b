// The stepper as a C++ object.
#include <doctest/doctest.h>

#include <utility>

#include "stepper/stepper_world.hpp"
#include "supernormal/stepper.hpp"

using namespace supernormal::test;
using supernormal::ode::Stepper;

TEST_CASE("the C++ object does what the C functions do, and throws what they refuse") {
  OdeSession session;
  const World world;
  Stepper made(world.id());
  Stepper stepper = std::move(made);
  stepper.set_accuracy(dReal(1e-3));
  const dBodyID ball = world.add(snCreateEllipsoid(world.space(), dReal(0.05), dReal(0.05), dReal(0.05)), 1000);
  dBodySetPosition(ball, 0, 0, dReal(0.05));
  stepper.add_body(ball);
  dContact contact{};
  contact.surface.mode = dContactApprox1;
  contact.geom.normal[2] = 1;
  for (int i = 0; i < 5; ++i) {
    stepper.add_contact(contact, ball, nullptr);
    CHECK(stepper.step(dReal(0.01)) == dReal(0.01));
  }
  CHECK(stepper.contact_force(0).z() == doctest::Approx(kGravity * mass_of(ball)));
  CHECK_THROWS_WITH_AS(stepper.contact_force(1), doctest::Contains("contact = 1 is not one of the 1 contacts"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(stepper.step(0), doctest::Contains("snStepperStep: step = 0"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(stepper.add_body(ball), doctest::Contains("must be added once"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(stepper.set_accuracy(2), doctest::Contains("sag = 2 is outside"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(Stepper(nullptr), doctest::Contains("world = NULL"), std::invalid_argument);
  stepper.remove_body(ball);
  CHECK_THROWS_WITH_AS(stepper.add_contact(contact, ball, nullptr), doctest::Contains("body1 is not a body of the stepper"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(stepper.remove_body(ball), doctest::Contains("body is not a body of the stepper"), std::invalid_argument);
}
