// Tests with many bodies on one another. A wall and a pile come to rest, and no body sinks, creeps or gains energy.
#include <doctest/doctest.h>

#include "support/ode_world.hpp"

using namespace supernormal::test;

namespace {

/// Sets ODE's auto-disable as samples/studies/README.md recommends: thresholds for the bodies' size, over the mean of ten steps.
void let_sleep(const World& world, double size) {
  dWorldSetAutoDisableFlag(world.id(), 1);
  dWorldSetAutoDisableAverageSamplesCount(world.id(), 10);
  dWorldSetAutoDisableLinearThreshold(world.id(), dReal(0.01));
  dWorldSetAutoDisableAngularThreshold(world.id(), dReal(0.01 / size));
}

/// Adds a dBox, or, if there is an exponent, a superellipsoid.
dBodyID add_brick(const World& world, const Vec& half_axes, double exponent) {
  const auto a = dReal(half_axes[0]), b = dReal(half_axes[1]), c = dReal(half_axes[2]), e = dReal(exponent);
  if (exponent > 0) return world.add(snCreateSuperellipsoid(world.space(), a, b, c, e, e), 1000);
  dMass mass;
  dMassSetBox(&mass, 1000, 2 * a, 2 * b, 2 * c);
  return world.add(dCreateBox(world.space(), 2 * a, 2 * b, 2 * c), mass);
}

struct Watch {
  double start;
  double least;
  double gained = 0;   ///< J
  double deepest = 0;  ///< m
  int steps = 0;
  bool asleep = false;
};

/// Steps until all bodies sleep, at most for the time `timeout`, s.
Watch settle(World& world, const std::vector<dBodyID>& bodies, double dt, double timeout) {
  const auto energy_of_all = [&] {
    double sum = 0;
    for (const dBodyID body : bodies) sum += energy(body);
    return sum;
  };
  const double start = energy_of_all();
  Watch watch{start, start};
  while (!watch.asleep && watch.steps * dt < timeout) {
    world.quick_step(dt);
    ++watch.steps;
    const double now = energy_of_all();
    watch.gained = std::max(watch.gained, now - watch.least);
    watch.least = std::min(watch.least, now);
    watch.deepest = std::max(watch.deepest, world.depth);
    watch.asleep = std::none_of(bodies.begin(), bodies.end(), [](dBodyID body) { return dBodyIsEnabled(body) != 0; });
  }
  return watch;
}

}  // namespace

TEST_CASE("a wall of 50 bricks stands, and falls asleep as soon as a wall of dBoxes") {
  const double a = 0.1;
  const double b = 0.06;
  const double c = 0.04;
  const auto build_and_settle = [&](bool boxes) {
    OdeSession session;
    World world;
    let_sleep(world, c);
    dWorldSetQuickStepNumIterations(world.id(), 40);
    world.set_friction(0.5);
    world.add_plane();
    std::vector<dBodyID> bricks;
    std::vector<Vec> start;
    for (int course = 0; course < 10; ++course) {
      for (int i = 0; i < 5; ++i) {
        bricks.push_back(add_brick(world, {a, b, c}, boxes ? 0 : 20));
        start.push_back({(2 * a + 0.002) * (i + 0.25 * (course % 2)), 0, c + (2 * c + 1e-4) * course});
        set_position(bricks.back(), start.back());
      }
    }
    const Watch watch = settle(world, bricks, 1e-3, 3);
    CHECK(watch.asleep);
    CHECK(watch.gained < 1e-3 * watch.start);
    CHECK(watch.deepest < 0.005 * c);
    for (std::size_t i = 0; i < bricks.size(); ++i) {
      // The gaps of 0.1 mm between the courses have closed, and no brick has moved otherwise.
      const auto course = static_cast<int>(i) / 5;
      const Vec moved = to_vec(dBodyGetPosition(bricks[i])) - start[i];
      CHECK(std::hypot(moved[0], moved[1]) < 0.01 * c);
      CHECK(std::abs(moved[2] + 1e-4 * course) < 0.01 * c);
    }
    return watch.steps;
  };
  const int steps_of_boxes = build_and_settle(true);
  CHECK(build_and_settle(false) <= 2 * steps_of_boxes);
}

TEST_CASE("60 needles side by side fall asleep") {
  const double c = 0.005;
  for (const double exponent : {0.0, 6.0, 8.0, 20.0}) {  // 0: dBoxes
    OdeSession session;
    World world;
    dWorldSetAutoDisableFlag(world.id(), 1);
    world.set_friction(0.5);
    world.add_plane();
    Random random(5);
    std::vector<dBodyID> needles;
    for (int k = 0; k < 60; ++k) {
      needles.push_back(add_brick(world, {40 * c, c, c}, exponent));
      set_position(needles.back(), {random.uniform(-c, c), 2.2 * c * k + random.uniform(-0.1, 0.1) * c, 3.2 * c});
      turn(needles.back(), {0, 1, 0}, random.uniform(-0.002, 0.002));
    }
    const Watch watch = settle(world, needles, 2e-3, 3);
    CAPTURE(exponent);
    CHECK(watch.asleep);
    MESSAGE("exponent ", exponent, ": asleep after ", 2e-3 * watch.steps, " s, gained ", watch.gained / watch.start);
  }
}

TEST_CASE_FIXTURE(OdeSession, "a pile of mixed grains comes to rest") {
  // The long run is samples/scenes/pile.toml: 1000 grains, 1e5 steps.
  World world;
  dHashSpaceSetLevels(world.space(), -8, -6);  // cells of 4…16 mm
  let_sleep(world, 0.003);
  dWorldSetQuickStepNumIterations(world.id(), 40);
  world.set_friction(0.5);
  const double wall = 0.025;
  world.add_plane();
  for (const double side : {-1.0, 1.0}) {
    dCreatePlane(world.space(), dReal(-side), 0, 0, dReal(-wall));
    dCreatePlane(world.space(), 0, dReal(-side), 0, dReal(-wall));
  }
  const std::array<double, 6> exponents = {1.3, 2, 2, 3, 8, 30};
  Random random(11);
  std::vector<dBodyID> grains;
  for (int i = 0; i < 90; ++i) {
    const auto exponent = [&] { return dReal(exponents[static_cast<std::size_t>(random.uniform(0, 5.999))]); };
    const double c = random.uniform(2.5e-3, 3.5e-3);
    const std::array<dReal, 4> p = {dReal(c * random.uniform(1, 1.8)), dReal(c * random.uniform(1, 1.4)), exponent(), exponent()};
    const dGeomID geom = snCreateSuperellipsoid(world.space(), p[0], p[1], dReal(c), p[2], p[3]);
    grains.push_back(world.add(geom, 1200));
    random.turn(geom);
    const int layer = i / 9;
    const int row = i / 3 % 3 - 1;
    place(geom, {0.0145 * (i % 3 - 1), 0.0145 * row, 0.009 + 0.0145 * layer});
  }
  const Watch watch = settle(world, grains, 5e-4, 3);
  CHECK(watch.asleep);
  CHECK(watch.gained < 1e-4 * watch.start);
  CHECK(watch.deepest < 0.5 * 2.5e-3);  // the depth of an impact at 1.6 m/s in one step
  CHECK(world.depth < 0.01 * 2.5e-3);   // the depth at rest
  for (const dBodyID grain : grains) {
    const Vec p = to_vec(dBodyGetPosition(grain));
    CHECK(std::max(std::abs(p[0]), std::abs(p[1])) < wall);
    CHECK(p[2] > 0);
  }
}
