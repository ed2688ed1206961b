// The stepper as a C++ object.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "stepper/stepper_world.hpp"
#include "supernormal/stepper.hpp"

using namespace supernormal::test;
using supernormal::ode::Stepper;

TEST_CASE("a stepper that takes what another one has saved goes on as that one, and refuses what is no such thing") {
  OdeSession session;
  // 0: nothing else; 1: another stepper takes what is saved; 2: another one begins anew
  std::array<double, 3> sink{};
  for (const int way : {0, 1, 2}) {
    const World world;
    REQUIRE(snSetDefaultLookAhead(dReal(0.01)) == 1);
    std::vector<dGeomID> geoms = {dCreatePlane(world.space(), 0, 0, 1, 0)};
    std::optional<Stepper> stepper(std::in_place, world.id());
    std::vector<dBodyID> bodies;
    for (int i = 0; i < 2; ++i) {
      geoms.push_back(snCreateSuperellipsoid(world.space(), dReal(0.1), dReal(0.07), dReal(0.05), 8, 8));
      bodies.push_back(world.add(geoms.back(), i == 0 ? 1000 : 2e4));
      dBodySetPosition(bodies.back(), 0, 0, dReal(0.05 + 0.1 * i));
      stepper->add_body(bodies.back());
    }
    const auto step = [&] {
      for (std::size_t i = 0; i < 2; ++i) {
        std::array<dContact, World::kRoom> found{};
        const int count = dCollide(geoms[i], geoms[i + 1], World::kRoom, &found[0].geom, sizeof(dContact));
        for (int k = 0; k < count; ++k) {
          found[std::size_t(k)].surface.mode = dContactApprox1;
          stepper->add_contact(found[std::size_t(k)], dGeomGetBody(geoms[i]), dGeomGetBody(geoms[i + 1]));
        }
      }
      CHECK(stepper->step(dReal(0.01)) == dReal(0.01));
    };
    for (int i = 0; i < 100; ++i) step();
    const double before = place_of(bodies[1])[2];
    std::vector<double> saved = stepper->save(geoms);
    CHECK(stepper->save({}).size() < saved.size());
    if (way > 0) {
      stepper.reset();
      stepper.emplace(world.id());
      for (const dBodyID body : bodies) stepper->add_body(body);
    }
    if (way == 1) {
      stepper->load(geoms, saved);
      CHECK(stepper->save(geoms) == saved);
      CHECK_THROWS_WITH_AS(stepper->load({}, saved), doctest::Contains("numbers are none of snStepperSave"), std::invalid_argument);
      saved.back() = std::nan("");
      CHECK_THROWS_AS(stepper->load(geoms, saved), std::invalid_argument);
      saved.pop_back();
      CHECK_THROWS_AS(stepper->load(geoms, saved), std::invalid_argument);
      CHECK_THROWS_AS(stepper->load(geoms, {}), std::invalid_argument);
    }
    step();
    sink[std::size_t(way)] = place_of(bodies[1])[2] - before;
  }
  CHECK(sink[1] == sink[0]);
  CHECK(std::abs(sink[2]) > 1e-6 + std::abs(sink[0]));
}

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
