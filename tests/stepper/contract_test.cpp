// What the snStepper… functions promise besides motions.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stepper/stepper_world.hpp"
#include "supernormal/stepper.hpp"

using namespace supernormal::test;
using supernormal::ode::Stepper;

namespace {

constexpr dReal kNotANumber = std::numeric_limits<dReal>::quiet_NaN();

dContact contact_at(const Vec& place) {
  dContact contact{};
  contact.surface.mode = dContactApprox1;
  for (std::size_t k = 0; k < 3; ++k) contact.geom.pos[k] = dReal(place[k]);
  contact.geom.normal[2] = 1;
  return contact;
}

/// Positions and velocities after a fall of grains.
std::vector<double> fall() {
  OnFloor scene(0.005);
  Random random(3);
  std::vector<dBodyID> bodies;
  for (int i = 0; i < 12; ++i) {
    const auto exponent = dReal(i % 2 == 0 ? 2 : 8);
    const dGeomID geom = snCreateSuperellipsoid(scene.world.space(), dReal(0.05), dReal(0.04), dReal(0.03), exponent, exponent);
    bodies.push_back(scene.add(geom, 1000, {0.01 * (i % 3), 0.01 * (i % 2), 0.1 + 0.1 * i}));
    random.turn(geom);
  }
  scene.run(0.7);
  std::vector<double> digits;
  for (const dBodyID body : bodies) {
    for (const Vec& v : {place_of(body), velocity_of(body), spin_of(body)}) digits.insert(digits.end(), v.begin(), v.end());
  }
  return digits;
}

}  // namespace

TEST_CASE("two runs give the same digits, wherever their geoms are in memory") {
  const std::vector<double> first = fall();
  std::array<std::unique_ptr<char[]>, 100> in_the_way;
  for (std::size_t i = 0; i < in_the_way.size(); ++i) in_the_way[i] = std::make_unique<char[]>(50 + 37 * i);
  CHECK(fall() == first);
}

TEST_CASE("bodies, contacts, steps and accuracies out of range are refused, and nothing changes") {
  CHECK(refused(snStepperCreate(nullptr), "snStepperCreate: world = NULL"));
  StepperWorld scene(0.01);
  CHECK(refused(snStepperCreate(scene.world.id()), "snStepperCreate: world has a stepper already"));
  const World other;
  for (int i = 0; i < 2; ++i) {
    const snStepperID of_other = snStepperCreate(other.id());
    CHECK(of_other != nullptr);
    snStepperDestroy(of_other);
  }
  const snStepperID stepper = scene.stepper;
  const dBodyID ball = scene.add_ball(0.05, {0, 0, 0.05});
  const dBodyID stranger = dBodyCreate(scene.world.id());
  CHECK(refused(snStepperAddBody(stepper, ball), "it must be added once"));
  CHECK(refused(snStepperAddBody(stepper, dBodyCreate(other.id())), "another world"));
  CHECK(refused(snStepperRemoveBody(stepper, stranger), "body is not a body of the stepper"));

  dContact contact = contact_at({0, 0, 0});
  CHECK(refused(snStepperAddContact(stepper, &contact, ball, stranger), "body2 is not a body of the stepper"));
  CHECK(snStepperAddContact(stepper, &contact, ball, ball) == 0);
  CHECK(snStepperAddContact(stepper, nullptr, ball, nullptr) == 0);
  const auto refuses = [&](dReal& number, dReal value, const char* message) {
    const dReal before = number;
    number = value;
    CHECK_MESSAGE(snStepperAddContact(stepper, &contact, ball, nullptr) == 0, message);
    CHECK_MESSAGE(refused_with(message), snLastError());
    number = before;
  };
  refuses(contact.geom.depth, kNotANumber, "geom.depth = nan m");
  refuses(contact.geom.pos[1], kNotANumber, "geom.pos = (0, nan, 0)");
  refuses(contact.geom.normal[2], 2, "length of geom.normal = 2");
  refuses(contact.surface.mu, -1, "surface.mu = -1");
  contact.surface.mode |=
      dContactMu2 | dContactBounce | dContactSoftERP | dContactSoftCFM | dContactMotion1 | dContactSlip1 | dContactRolling;
  refuses(contact.surface.mu2, -1, "surface.mu2 = -1");
  refuses(contact.surface.bounce, 2, "surface.bounce = 2");
  refuses(contact.surface.soft_erp, 2, "surface.soft_erp = 2");
  refuses(contact.surface.soft_cfm, -1, "surface.soft_cfm = -1");
  refuses(contact.surface.motion1, kNotANumber, "surface.motion1 = nan");
  refuses(contact.surface.slip1, -1, "surface.slip1 = -1");
  refuses(contact.surface.rho, kNotANumber, "surface.rho = nan");
  contact.surface.mode |= dContactFDir1;
  refuses(contact.fdir1[2], 1, "length of fdir1 along the surface = 0");

  for (const dReal step : {dReal(0), dReal(-1), kNotANumber, std::numeric_limits<dReal>::infinity()}) {
    CHECK(snStepperStep(stepper, step) < 0);
    CHECK(refused_with("snStepperStep: step = "));
  }
  CHECK(snStepperSetAccuracy(stepper, 0, 8, 64) == 0);
  CHECK(snStepperSetAccuracy(stepper, dReal(1e-3), 0, 64) == 0);
  CHECK(refused(snStepperSetAccuracy(stepper, dReal(1e-3), 8, 7), "most = 7 is outside [8, "));
  dVector3 force;
  CHECK(refused(snStepperContactForce(stepper, 0, force), "contact = 0 is not one of the 0 contacts"));

  dBodyAddForce(ball, kNotANumber, 0, 0);
  CHECK(snStepperStep(stepper, dReal(0.01)) < 0);
  CHECK(refused_with("force on a body = (nan, 0, 0) is not finite"));
  dBodySetForce(ball, 0, 0, 0);
  set_velocity(ball, {std::numeric_limits<double>::infinity(), 0, 0});
  CHECK(snStepperStep(stepper, dReal(0.01)) < 0);
  CHECK(refused_with("velocity of a body = (inf, 0, 0) is not finite"));
  set_velocity(ball, {0, 0, 0});
  CHECK(place_of(ball) == Vec{0, 0, dReal(0.05)});
  CHECK(snStepperStep(stepper, dReal(0.01)) == dReal(0.01));
}

TEST_CASE("a body that is removed, and then destroyed, takes its contacts with it") {
  OnFloor scene(0.01, 0);
  const dBodyID first = scene.add_ball(0.05, {0, 0, 0.05});
  const dBodyID second = scene.add_ball(0.05, {0, 0, 0.15});
  const dBodyID third = scene.add_ball(0.05, {0.5, 0, 0.05});
  scene.run(0.2);
  scene.collide();
  REQUIRE(scene.contacts == 3);
  REQUIRE(snStepperRemoveBody(scene.stepper, first) == 1);
  dGeomDestroy(dBodyGetFirstGeom(first));
  dBodyDestroy(first);
  REQUIRE(snStepperStep(scene.stepper, dReal(0.01)) > 0);
  CHECK(velocity_of(second)[2] == doctest::Approx(-0.01 * kGravity));
  CHECK(std::abs(velocity_of(third)[2]) < 1e-6);  // carried, though the last body is now in the place of the first
  dVector3 force;
  double carried = 0;
  for (int i = 0; i < 3; ++i) {
    REQUIRE(snStepperContactForce(scene.stepper, i, force) == 1);
    carried += double{force[2]};
  }
  CHECK(std::abs(carried) == doctest::Approx(kGravity * mass_of(third)).epsilon(1e-3));
}

TEST_CASE("a body at the address of a removed one does not take over its forces") {
  OnFloor scene(0.01, 0);
  double highest = 0;
  for (int i = 0; i < 6; ++i) {
    const dBodyID brick = scene.add_brick(20, i % 2 == 0 ? 1e5 : 1, {0, 0, 0.05});
    for (int k = 0; k < 20; ++k) {
      scene.step();
      highest = std::max(highest, place_of(brick)[2]);
    }
    REQUIRE(snStepperRemoveBody(scene.stepper, brick) == 1);
    dGeomDestroy(dBodyGetFirstGeom(brick));
    dBodyDestroy(brick);
  }
  CHECK(highest < 0.0501);
}

TEST_CASE("a step that is far shorter than the others, as what rounding leaves of a frame, throws nothing and costs nothing") {
  for (const double rest : {1e-4, 1e-6, 1e-9, 1e-15}) {
    OnFloor scene(0.02);
    const std::vector<dBodyID> tower = scene.add_tower(5);
    // One falls, so that the short step has an impact.
    const dBodyID falling = scene.add_brick(8, 1000, {0.5, 0, 0.05 + 0.5 * kGravity * 0.25 * 0.25});
    scene.run(0.24);
    for (int i = 0; i < 3; ++i) {
      scene.step(rest);
      scene.step();
      CHECK(std::abs(velocity_of(tower.back())[2]) < 0.05);
    }
    scene.run(0.4);
    CHECK_MESSAGE(place_of(tower.back())[2] == doctest::Approx(0.45).epsilon(3e-3), rest);
    CHECK_MESSAGE(place_of(falling)[2] == doctest::Approx(0.05).epsilon(2e-2), rest);
  }
}

TEST_CASE("a step ends early where a bullet throws a brick on, and the brick does not pass a wall") {
  StepperWorld scene(0.01);
  dWorldSetGravity(scene.world.id(), 0, 0, 0);
  const dBodyID bullet =
      scene.add(snCreateEllipsoid(scene.world.space(), dReal(0.02), dReal(0.02), dReal(0.02)), 7800, {-0.5, 0, 0});
  const dBodyID brick = scene.add_brick(8, 1000, {0, 0, 0});
  const dGeomID wall = dCreateBox(scene.world.space(), dReal(0.01), 2, 2);
  dGeomSetPosition(wall, dReal(0.3), 0, 0);
  set_velocity(bullet, {1000, 0, 0});
  dGeomMoved(dBodyGetFirstGeom(bullet));
  int parts = 0;
  for (int i = 0; i < 20; ++i) {
    scene.step();
    parts = std::max(parts, scene.parts);
  }
  CHECK(parts > 1);
  CHECK(place_of(brick)[0] < 0.25);
  CHECK(place_of(bullet)[0] < place_of(brick)[0]);
}

TEST_CASE("a ball that is struck within a step hardly overlaps what it was not foreseen to meet") {
  const double size = 0.05 * std::sqrt(0.4);  // m, the radius of gyration
  for (const double gap : {0.001, 0.002, 0.004, 0.01, 0.02}) {
    CAPTURE(gap);
    StepperWorld scene(0.01);
    dWorldSetGravity(scene.world.id(), 0, 0, 0);
    scene.surface.mode |= dContactBounce;
    scene.surface.bounce = 1;
    const dBodyID striker = scene.add_ball(0.05, {-0.12, 0, 0});
    const dBodyID struck = scene.add_ball(0.05, {0, 0, 0});
    const dBodyID other = scene.add_ball(0.05, {0.1 + gap, 0, 0});
    set_velocity(striker, {10, 0, 0});
    dGeomMoved(dBodyGetFirstGeom(striker));
    for (double left = 0.02; left > 1e-9;) {
      scene.collide();
      left -= double{snStepperStep(scene.stepper, dReal(std::min(left, 0.01)))};
      CHECK(0.1 - (place_of(other)[0] - place_of(struck)[0]) < 0.12 * size);
    }
    CHECK(velocity_of(other)[0] == doctest::Approx(10));
  }
}

TEST_CASE("forces that are added once act for a whole step, also if it ends early; those added for the rest take their place") {
  // 0: once a step; 1: before each call; 2: once, and the rest is never asked for; 3: once, on a body that quickstep moves
  for (const int way : {0, 1, 2, 3}) {
    StepperWorld scene(0.01);
    dWorldSetGravity(scene.world.id(), 0, 0, 0);
    const dBodyID bullet = scene.add_ball(0.02, {-0.125, 0, 0});
    scene.add_ball(0.02, {0, 0, 0});
    const dBodyID pushed = scene.add_ball(0.05, {0, 5, 0});
    const dBodyID held = scene.add_ball(0.05, {0, 7, 0});
    dJointAttach(dJointCreateLMotor(scene.world.id(), nullptr), held, nullptr);
    set_velocity(bullet, {10, 0, 0});
    dGeomMoved(dBodyGetFirstGeom(bullet));
    const dBodyID body = way == 3 ? held : pushed;
    const auto push = [&] {
      dBodyAddForce(body, 0, 0, 3);
      dBodyAddTorque(body, 0, 0, dReal(1e-3));
    };
    double time = 0;
    int parts = 0;
    for (int i = 0; i < 2; ++i) {
      push();
      double left = 0.01;
      do {
        if (left < 0.01 && way == 1) push();
        scene.collide();
        const double done = snStepperStep(scene.stepper, dReal(left));
        REQUIRE(done > 0);
        time += done;
        left = done >= left ? 0 : left - done;
        ++parts;
      } while (left > 0 && way != 2);
    }
    CHECK(parts > (way == 2 ? 1 : 2));
    CHECK_MESSAGE(velocity_of(body)[2] == doctest::Approx(3 * time / mass_of(body)).epsilon(1e-6), way);
    CHECK_MESSAGE(spin_of(body)[2] == doctest::Approx(1e-3 * time / (0.4 * mass_of(body) * 0.0025)).epsilon(1e-6), way);
  }
}

TEST_CASE("kinematic bodies move as told, and push what they meet") {
  OnFloor scene(0.01, 0.3);
  const dBodyID brick = scene.add_brick(8, 1000, {0, 0, 0.05});
  const dBodyID pusher = scene.add_brick(8, 1000, {-0.25, 0, 0.051});
  dBodySetKinematic(pusher);
  set_velocity(pusher, {0.1, 0, 0});
  scene.run(2);
  CHECK(place_of(pusher)[0] == doctest::Approx(-0.05));
  CHECK(place_of(brick)[0] - place_of(pusher)[0] == doctest::Approx(0.2).epsilon(1e-3));
  CHECK(velocity_of(brick)[0] == doctest::Approx(0.1));
}

TEST_CASE("a brick rides on a kinematic plate that turns") {
  for (const double step : {0.002, 0.01}) {
    StepperWorld scene(step);
    scene.surface.mu = dReal(0.5);
    const dBodyID plate = dBodyCreate(scene.world.id());
    dGeomSetBody(dCreateBox(scene.world.space(), 2, 2, dReal(0.1)), plate);
    dBodySetPosition(plate, 0, 0, dReal(-0.05));
    dBodySetKinematic(plate);
    REQUIRE(snStepperAddBody(scene.stepper, plate) == 1);
    set_spin(plate, {0, 0, 3});
    const dBodyID brick = scene.add_brick(20, 1000, {0.3, 0, 0.05});
    set_velocity(brick, {0, 0.9, 0});
    set_spin(brick, {0, 0, 3});
    scene.run(2);
    const double tangents = 3 * 3 * step / 8 / 2 * 2;  // of eight sub-steps a step would lead outwards
    CHECK(std::abs(std::hypot(place_of(brick)[0], place_of(brick)[1]) / 0.3 - 1) < 0.1 * tangents);
    CHECK(spin_of(brick)[2] == doctest::Approx(3).epsilon(1e-4));
  }
}

TEST_CASE("gravity modes, damping and the largest angular speed are those of the bodies") {
  StepperWorld scene(0.01);
  const dBodyID floating = scene.add_ball(0.05, {0, 0, 1});
  dBodySetGravityMode(floating, 0);
  set_velocity(floating, {1, 0, 0});
  dBodySetLinearDamping(floating, dReal(0.1));
  set_spin(floating, {0, 0, 100});
  dBodySetMaxAngularSpeed(floating, 10);
  scene.run(0.1);
  CHECK(velocity_of(floating)[0] == doctest::Approx(std::pow(0.9, 10)));
  CHECK(velocity_of(floating)[2] == 0);
  CHECK(spin_of(floating)[2] == doctest::Approx(10));
}

TEST_CASE("a disabled body sleeps until something that moves touches it") {
  OnFloor scene(0.01, 0);
  const dBodyID brick = scene.add_brick(8, 1000, {0, 0, 0.2});
  dBodyDisable(brick);
  scene.run(0.1);
  CHECK(place_of(brick)[2] == dReal(0.2));
  CHECK(dBodyIsEnabled(brick) == 0);
  scene.add_ball(0.05, {0, 0, 0.35});
  scene.run(0.5);
  CHECK(dBodyIsEnabled(brick) == 1);
  CHECK(place_of(brick)[2] < 0.06);
}

TEST_CASE("bodies at rest fall asleep together, stay, and wake together") {
  OnFloor scene(0.01);
  scene.let_sleep();
  const std::vector<dBodyID> tower = scene.add_tower(12);
  const dBodyID apart = scene.add_ball(0.05, {1, 0, 0.05});
  set_velocity(apart, {0, 0.5, 0});
  scene.run(2);
  for (const dBodyID body : tower) CHECK(dBodyIsEnabled(body) == 0);
  CHECK(dBodyIsEnabled(apart) == 1);
  const Vec before = place_of(tower.back());
  scene.run(0.1);
  CHECK(place_of(tower.back()) == before);
  dBodyEnable(tower.back());
  set_velocity(tower.back(), {0.3, 0, 0});
  scene.step();
  for (const dBodyID body : tower) CHECK(dBodyIsEnabled(body) == 1);
  scene.run(2);
  for (const dBodyID body : tower) CHECK(dBodyIsEnabled(body) == 0);
  CHECK(place_of(tower.back())[0] > 0.005);
  CHECK(place_of(tower.back())[2] == doctest::Approx(1.15).epsilon(1e-3));
}

TEST_CASE("quickstep moves bodies that were not added, and bodies of other joints with all that they touch") {
  OnFloor scene(0.01);
  const dBodyID free = scene.world.add(snCreateEllipsoid(scene.world.space(), 1, 1, 1), 1000);
  dBodySetPosition(free, 0, 50, 100);
  const dBodyID left = scene.add_ball(0.05, {0, 0, 0.05});
  const dBodyID right = scene.add_ball(0.05, {0.12, 0, 0.05});
  const dBodyID top = scene.add_brick(8, 1000, {0.06, 0, 0.152});
  const dBodyID aside = scene.add_brick(8, 1000, {1, 0, 0.05});
  const dJointID rod = dJointCreateDBall(scene.world.id(), nullptr);
  dJointAttach(rod, left, right);
  dJointSetDBallAnchor1(rod, 0, 0, dReal(0.05));
  dJointSetDBallAnchor2(rod, dReal(0.12), 0, dReal(0.05));
  scene.run(1);
  CHECK(place_of(free)[2] == doctest::Approx(100 - 0.5 * kGravity * 1.01));  // 100 steps of ODE
  CHECK(place_of(right)[0] - place_of(left)[0] == doctest::Approx(0.12).epsilon(1e-3));
  CHECK(place_of(top)[2] == doctest::Approx(0.15).epsilon(1e-2));
  CHECK(place_of(aside)[2] == doctest::Approx(0.05).epsilon(1e-3));
  scene.collide();
  REQUIRE(snStepperStep(scene.stepper, dReal(0.01)) > 0);
  double on_floor = 0;
  for (int i = 0; i < scene.contacts; ++i) {
    dVector3 force;
    REQUIRE(snStepperContactForce(scene.stepper, i, force) == 1);
    on_floor += std::abs(double{force[2]});
  }
  for (const dBodyID body : {left, right, top}) CHECK(snStepperMoves(scene.stepper, body) == 0);
  CHECK(snStepperMoves(scene.stepper, aside) == 1);
  CHECK(snStepperMoves(scene.stepper, free) == -1);
  CHECK(std::string(snLastError()) == "snStepperMoves: body is not a body of the stepper: add it by snStepperAddBody");
  const double weight = kGravity * (2 * mass_of(left) + 2 * mass_of(top) + mass_of(aside));  // the brick on top is carried twice
  CHECK(on_floor == doctest::Approx(weight).epsilon(0.05));
}

TEST_CASE("contacts that are added twice carry as those that are added once") {
  OnFloor scene(0.01);
  const std::vector<dBodyID> tower = scene.add_tower(6);
  for (int i = 0; i < 200; ++i) {
    scene.collide();
    scene.collide();
    REQUIRE(snStepperStep(scene.stepper, dReal(0.01)) == dReal(0.01));
  }
  CHECK(place_of(tower.back())[2] == doctest::Approx(0.55).epsilon(1e-3));
  CHECK(norm(velocity_of(tower.back())) < 1e-6);
}

TEST_CASE("a kinematic body that jumps into a pile throws nothing faster than its overlap allows, and the pile rests again") {
  OnFloor scene(0.01);
  const std::vector<dBodyID> tower = scene.add_tower(3);
  const dBodyID block = scene.add_brick(8, 1000, {1, 0, 0.05});
  dBodySetKinematic(block);
  scene.run(0.5);
  dBodySetPosition(block, dReal(0.17), 0, dReal(0.05));  // 3 cm deep
  double fastest = 0;
  for (int i = 0; i < 200; ++i) {
    scene.step();
    for (const dBodyID body : tower) fastest = std::max(fastest, norm(velocity_of(body)));
  }
  CHECK(fastest < 2);
  for (const dBodyID body : tower) CHECK(norm(velocity_of(body)) < 1e-4);
}

TEST_CASE("steps whose length changes, and a mass ratio of a million, throw nothing") {
  OnFloor scene(0.01);
  const dBodyID light = scene.add_brick(8, 1e-3, {0, 0, 0.05});
  const dBodyID heavy = scene.add_brick(8, 1e3, {0, 0, 0.15});
  for (int i = 0; i < 300; ++i) {
    scene.step(i % 3 == 0 ? 1e-4 : i % 3 == 1 ? 0.02 : 3e-3);
    for (const dBodyID body : {light, heavy}) {
      REQUIRE(std::isfinite(norm(place_of(body)) + norm(velocity_of(body)) + norm(spin_of(body))));
      REQUIRE(norm(velocity_of(body)) < 10);
    }
  }
}

TEST_CASE_FIXTURE(OdeSession,
                  "a stepper that takes what another one has saved goes on as that one, and refuses what is no such thing") {
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

TEST_CASE_FIXTURE(OdeSession, "the C++ object does what the C functions do, and throws what they refuse") {
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
