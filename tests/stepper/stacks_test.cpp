// Stacks at long steps, which the plain solver does not hold: a tower of 20 falls at 10 ms, and a brick does not carry a hundred
// times its mass.
#include <doctest/doctest.h>

#include "stepper/stepper_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

/// Bricks one on another, each a little aside and turned.
std::vector<dBodyID> add_tower(StepperWorld& scene, int bricks, double exponent, double top_density, Random& random) {
  std::vector<dBodyID> tower;
  tower.reserve(static_cast<std::size_t>(bricks));
  for (int i = 0; i < bricks; ++i) {
    const double aside = 0.003;
    const Vec at = {random.uniform(-aside, aside), random.uniform(-aside, aside), 0.05 + 0.1 * i + 0.001 * (i + 1)};
    tower.push_back(scene.add_brick(exponent, i == bricks - 1 ? top_density : 1000, at));
    turn(tower.back(), {0, 0, 1}, random.uniform(-0.03, 0.03));
  }
  return tower;
}

/// Steps until all has settled, checks that nothing moves more than `drift` (m) in the second half and that the tower stands.
void check_stands(StepperWorld& scene, const std::vector<dBodyID>& tower, double drift) {
  scene.run(1.5);
  std::vector<Vec> before;
  before.reserve(tower.size());
  for (const dBodyID body : tower) before.push_back(place_of(body));
  scene.run(0.5);
  for (std::size_t i = 0; i < tower.size(); ++i) {
    CHECK(norm(place_of(tower[i]) - before[i]) < drift);
    CHECK(std::abs(place_of(tower[i])[2] - (0.05 + 0.1 * double(i))) < 1e-3);
  }
}

}  // namespace

TEST_CASE("a tower of twenty bricks stands at steps of 20 and 33 ms") {
  OdeSession session;
  Random random(5);
  for (const double step : {0.02, 1.0 / 30}) {
    for (const double exponent : {8, 60}) {
      StepperWorld scene(step);
      scene.surface.mu = dReal(0.5);
      scene.world.add_plane();
      check_stands(scene, add_tower(scene, 20, exponent, 1000, random), 2e-3);
    }
  }
}

TEST_CASE("a brick carries a hundred times its mass") {
  OdeSession session;
  Random random(6);
  for (const double step : {0.002, 0.01, 0.033}) {
    StepperWorld scene(step);
    scene.surface.mu = dReal(0.5);
    scene.world.add_plane();
    check_stands(scene, add_tower(scene, 2, 8, 1e5, random), 1e-6);
  }
}

TEST_CASE("steps may change from one to the next") {
  OdeSession session;
  Random random(7);
  StepperWorld scene(0.02);  // the longest of them
  scene.surface.mu = dReal(0.5);
  scene.world.add_plane();
  const std::vector<dBodyID> tower = add_tower(scene, 6, 8, 1000, random);
  for (double time = 0; time < 1.5;) {
    const double step = random.log_uniform(2e-4, 0.02);
    scene.step(step);
    time += step;
  }
  for (std::size_t i = 0; i < tower.size(); ++i) CHECK(std::abs(place_of(tower[i])[2] - (0.05 + 0.1 * double(i))) < 1e-3);
}

TEST_CASE("the contact forces of a tower carry its weight") {
  OdeSession session;
  Random random(8);
  StepperWorld scene(0.01);
  scene.surface.mu = dReal(0.5);
  scene.world.add_plane();
  const std::vector<dBodyID> tower = add_tower(scene, 3, 8, 1000, random);
  scene.run(1);
  dVector3 force;
  double weights = 0;  // of what each contact carries, once a contact
  scene.collide();
  REQUIRE(snStepperStep(scene.stepper, dReal(0.01)) > 0);
  for (int i = 0; i < scene.contacts; ++i) {
    REQUIRE(snStepperContactForce(scene.stepper, i, force) == 1);
    weights += std::abs(double{force[2]});
  }
  // One brick is carried once, one twice, one three times.
  CHECK(weights == relative(6 * kGravity * mass_of(tower.front())).epsilon(1e-4));
}

TEST_CASE("accuracy decides how far a brick sinks into the floor") {
  OdeSession session;
  for (const double sag : {1e-4, 1e-2}) {
    StepperWorld scene(0.02);
    scene.world.add_plane();
    const dBodyID brick = scene.add_brick(8, 1000, {0, 0, 0.05});
    dMass mass;
    dBodyGetMass(brick, &mass);
    const double size = std::sqrt(double{mass.I[0]} / double{mass.mass});  // the least radius of gyration
    REQUIRE(snStepperSetAccuracy(scene.stepper, dReal(sag), 1, 1000) == 1);
    scene.run(3);
    const double depth = 0.05 - place_of(brick)[2];
    CHECK(depth > 0.3 * sag * size / 4);  // four contacts share the load
    CHECK(depth < 1.1 * sag * size);
  }
}
