// Tests of feeders and sinks in a world, against what they are told to do.
#include "world/population.hpp"

#include <doctest/doctest.h>
#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "model/grain_shape.hpp"
#include "observe/simulation.hpp"
#include "scenes.hpp"
#include "support/refusal.hpp"
#include "support/relative.hpp"
#include "world/world.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

constexpr double kStepOfChanges = 1e-3;  // s

GrainKind pea() { return {"pea", {3e-3, 3e-3, 3e-3}, 2, 2, 0, 1200, "test"}; }
GrainKind die() { return {"die", {4e-3, 4e-3, 4e-3}, 8, 8, 1e-3, 1190, "test"}; }

/// Grains fall from a region past a plane into a sink: nothing is in the way.
Scene falling_scene(std::vector<Feeder> feeders) {
  Scene scene = scene_of(Open{{{-0.1, -0.1, 0}, {0.2, 0.2, 1}}, {{-1, -1, -1}, {2, 2, 3}}}, {{pea(), 0}, {die(), 0}});
  scene.time = {2, kStepOfChanges, 0.1};
  scene.feeders = std::move(feeders);
  scene.sinks = {{"drain", HalfSpace{{0, 0, 0}, {0, 0, 1}}}};
  return scene;
}

Feeder feeder(Quantity rate) {
  return {"spout", {{-0.03, -0.03, 0.1}, {0.06, 0.06, 0.04}}, {{0, 0.7}, {1, 0.3}}, Quantity::Of::Grains, rate};
}

constexpr Quantity grains(double number) { return {number, Quantity::Of::Grains}; }
constexpr Quantity kilograms(double number) { return {number, Quantity::Of::Mass}; }

/// A simulation that counts its steps.
struct Plant : Simulation {
  explicit Plant(const Scene& scene) : Simulation(scene, 1) {}
  void step() { advance(++steps * kStepOfChanges); }
  void run_until(double time) {
    while ((steps + 0.5) * kStepOfChanges < time) step();
  }
  int steps = 0;
};

}  // namespace

TEST_CASE("a feeder delivers its rate, in grains and in kg") {
  const Scene in_grains = falling_scene({feeder(grains(333))});
  Plant first(in_grains);
  first.run_until(1.5);
  CHECK(static_cast<double>(first.population.fed().grains) == relative(333 * 1.5).epsilon(0.005));

  const Scene in_kg = falling_scene({feeder(kilograms(0.1))});
  Plant second(in_kg);
  second.run_until(1.5);
  CHECK(second.population.fed().mass == relative(0.15).epsilon(0.005));
  CHECK(second.population.fed().mass <= 0.15 * (1 + 1e-9));
}

TEST_CASE("the fractions of a mixture are exact to one grain at any time, by number and by mass") {
  for (const Quantity::Of of : {Quantity::Of::Grains, Quantity::Of::Mass}) {
    Feeder spout = feeder(grains(200));
    spout.fraction_of = of;
    const Scene scene = falling_scene({spout});
    Plant plant(scene);
    const double heaviest = std::max(mass_of(pea()), mass_of(die()));
    for (int i = 0; i < 500; ++i) {
      plant.step();
      const Feeding& feeding = plant.population.feeders()[0];
      const double whole = Quantity{0, of}.in(feeding.fed());
      const double peas = Quantity{0, of}.in(feeding.state().fed[0]);
      REQUIRE(std::abs(peas - 0.7 * whole) <= (of == Quantity::Of::Mass ? heaviest : 1.0));
    }
    CHECK(plant.population.fed().grains == 100);
  }
}

TEST_CASE("a feeder inserts sizes and compounds of its kinds") {
  Scene scene = falling_scene({feeder(kilograms(0.1))});
  scene.kinds[0].size = SizeDistribution::uniform({0.5, 1.5}, SizeDistribution::By::Number);
  scene.kinds[0].is_fed = true;
  scene.kinds[1].kind = make_compound("pair", {{{{2e-3, 2e-3, 2e-3}}, 1190}, {{{2e-3, 2e-3, 2e-3}}, 1190, {5e-3, 0, 0}}}, "test");
  Plant plant(scene);
  plant.run_until(1.5);
  CHECK(plant.population.fed().mass == relative(0.15).epsilon(0.005));
  double sum = 0;
  double number = 0;
  for (const Grain& grain : plant.world.grains()) {
    if (grain.kind->components.empty()) {
      CHECK(grain.scale >= 0.5);
      CHECK(grain.scale <= 1.5);
      CHECK(grain.mass.mass == relative(std::pow(grain.scale, 3) * mass_of(pea())).epsilon(1e-9));
      sum += grain.scale;
      ++number;
    } else {
      CHECK(grain.scale == 1);
      CHECK(grain.mass.mass == relative(mass_of(*grain.kind)).epsilon(1e-12));
      if (grain.is_present()) CHECK(grain.geoms().size() == 2);
    }
  }
  REQUIRE(number > 100);
  CHECK(std::abs(sum / number - 1) < 4 / std::sqrt(12 * number));  // four standard errors
  CHECK(plant.population.fed().grains == plant.population.taken().grains + plant.population.present().grains);
}

TEST_CASE("a feeder starts and stops on time, and at its total") {
  Feeder timed = feeder(grains(100));
  timed.from = 0.2;
  timed.until = 0.5;
  const Scene first = falling_scene({timed});
  Plant plant(first);
  plant.run_until(0.2);
  CHECK(plant.population.fed().grains == 0);
  plant.run_until(0.3);
  CHECK(plant.population.fed().grains == 10);
  plant.run_until(1);
  CHECK(plant.population.fed().grains == 30);

  for (const Quantity& total : {grains(7), kilograms(7.5e-4)}) {
    Feeder limited = feeder(grains(1000));
    limited.mixture = {{0, 1}};
    limited.total = total;
    const Scene scene = falling_scene({limited});
    Plant full(scene);
    full.run_until(0.5);
    const double mass = mass_of(pea());
    const double expected = total.of == Quantity::Of::Mass ? std::floor(total.number / mass) : total.number;
    CHECK(static_cast<double>(full.population.fed().grains) == expected);
  }
}

TEST_CASE("a feeder inserts grains without overlap, within its region and with its velocity") {
  Feeder dense = feeder(grains(2000));
  dense.velocity = {0.1, 0, -0.5};
  dense.total = grains(100);
  const Scene scene = falling_scene({dense});
  Plant plant(scene);
  for (; plant.population.fed().grains < 100; ++plant.steps, plant.stepper.step()) {
    REQUIRE(plant.steps < 1000);
    const std::size_t before = plant.world.grains().size();
    plant.population.before_step((plant.steps + 1) * kStepOfChanges);
    for (std::size_t i = before; i < plant.world.grains().size(); ++i) {
      const Grain& grain = plant.world.grains()[i];
      CHECK(dBodyGetLinearVel(grain.body)[0] == 0.1);
      CHECK(dBodyGetLinearVel(grain.body)[2] == -0.5);
      dReal aabb[6];
      dGeomGetAABB(grain.geom, aabb);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(aabb[2 * axis] >= dense.region.corner[axis]);
        CHECK(aabb[2 * axis + 1] <= dense.region.corner[axis] + dense.region.size[axis]);
      }
      for (const Grain& other : plant.world.present()) {
        if (&other == &grain) continue;
        snProximity proximity;
        REQUIRE(snGeomProximity(grain.geom, other.geom, &proximity) == 1);
        CHECK(proximity.gap > 0);
      }
    }
  }
}

TEST_CASE("a feeder whose region was full catches up, or ends the run with the reason") {
  Feeder narrow = feeder(grains(100));
  narrow.mixture = {{0, 1}};
  narrow.region = {{0, 0, 0.06}, {0.02, 0.02, 0.01}};
  narrow.velocity = {0, 0, -0.5};
  Scene scene = falling_scene({narrow});
  // A tube that is closed below the region until a plate moves away. A sink empties it.
  scene.container = Box{{0.02, 0.02}};
  scene.sinks = {{"floor", Region{{0, 0, 0}, {0.02, 0.02, 0.02}}}};
  scene.walls = walls_in(scene.container);
  scene.walls.push_back({"plate", BoxShape{{0.1, 0.1, 0.004}}, {{0.01, 0.01, 0.057}, Eigen::Quaterniond::Identity()}});
  scene.walls.back().motions = {{Translation{{1, 0, 0}}, 0.3}};
  scene.feeders[0].patience = 1;
  {
    Plant plant(scene);
    plant.run_until(0.3);
    CHECK(plant.population.fed().grains < 25);  // 30 are due
    CHECK(plant.population.feeders()[0].state().behind_since.has_value());
    plant.run_until(0.9);
    CHECK(plant.population.fed().grains == 90);
    CHECK(!plant.population.feeders()[0].state().behind_since.has_value());
  }
  scene.feeders[0].patience = 0.05;
  Plant plant(scene);
  const std::string message = supernormal::test::refusal<std::runtime_error>([&] { plant.run_until(0.3); });
  for (const char* part : {"feeder \"spout\"", "rate of 100 grains/s", "[0.02, 0.02, 0.01] m from [0, 0, 0.06] m", "had room for",
                           "allowed:", "feeder.patience above 0.05 s"}) {
    CAPTURE(message);
    CHECK(message.find(part) != std::string::npos);
  }
}

TEST_CASE("mass is conserved through feeders and sinks, and removed grains keep their index") {
  Scene scene = falling_scene({feeder(kilograms(0.05))});
  scene.kinds[0].count = 1;
  scene.sinks.insert(scene.sinks.begin(), {"side", Region{{0, -1, 0.02}, {1, 2, 0.03}}});
  scene.start = StartState{.grains = {{.position = {0, 0, 0.3}}}};
  Plant plant(scene);
  plant.run_until(1);
  const Population& population = plant.population;
  const auto both_sides = [](const Amount& a, const Amount& b) { return std::pair(a.grains + b.grains, a.mass + b.mass); };
  const auto [came, mass_came] = both_sides(population.at_start(), population.fed());
  const auto [is, mass_is] = both_sides(population.present(), population.taken());
  CHECK(came == is);
  CHECK(std::abs(mass_came - mass_is) < 1e-12);
  CHECK(population.taken().grains > 50);
  for (std::size_t sink = 0; sink < 2; ++sink) {
    for (std::size_t kind = 0; kind < 2; ++kind) CHECK(population.taken(sink)[kind].grains > 5);
  }
  CHECK(plant.world.grains().size() == came);
  CHECK(!plant.world.grains()[0].is_present());  // the first to fall through
  CHECK(plant.world.grains().back().is_present());
  std::size_t there = 0;
  for (const Grain& grain : plant.world.present()) {
    ++there;
    CHECK(&plant.world.grains()[plant.world.index_of(grain)] == &grain);
    CHECK(grain_of(grain.geom) == &grain);
  }
  CHECK(there == population.present().grains);
  CHECK(plant.watches.leaks.count() == 0);  // below the plane is in the sink
  // Grains in flight gain what a step's rounding of gravity brings, and what comes and goes is no gain.
  CHECK(plant.watches.energy.gained() < 1e-3 * 0.05 * 9.81 * 0.1);
}

TEST_CASE("mistakes in feeders and sinks are refused with the reason") {
  const std::string feeders = R"([[feeder]]
name = "spout"
corner = [0.01, 0.01, 0.05]
size = [0.03, 0.04, 0.03]
grains_per_second = 100
total_kg = 0.5
from = 0.02
velocity = [0, 0, -1]
[[feeder.grain]]
name = "pea"
fraction = 0.25
[[feeder.grain]]
name = "die"
fraction = 0.75
[[sink]]
name = "drain"
corner = [0, 0, 0]
size = [0.05, 0.06, 0.01]
)";
  const std::string text = kSceneText + feeders;
  CHECK(complaint(text).empty());
  const Scene scene = scene_of(text);
  REQUIRE(scene.feeders.size() == 1);
  CHECK(scene.feeders[0].mixture[1].kind == 1);
  CHECK(scene.feeders[0].mixture[1].fraction == 0.75);
  CHECK(scene.feeders[0].rate.of == Quantity::Of::Grains);
  CHECK(scene.feeders[0].total->of == Quantity::Of::Mass);
  CHECK(scene.sinks[0].contains({0.01, 0.01, 0.005}));
  CHECK(!scene.sinks[0].contains({0.01, 0.01, 0.015}));
  const std::vector<Mistake> mistakes = {
      {"grains_per_second = 100\n", "", {"feeder.grains_per_second and feeder.kg_per_second are missing", "one of them"}},
      {"total_kg = 0.5", "total_grains = 0.5", {"feeder.total_grains is 0.5; allowed: a whole number of grains, at least 1"}},
      {"total_kg = 0.5", "total_grains = 2.5", {"feeder.total_grains is 2.5; allowed: a whole number"}},
      {"total_kg = 0.5", "total_kg = 1e-6", {"feeder.total_kg is 1e-06; allowed: at least 0.000136 kg", "lightest grain"}},
      {"size = [0.03, 0.04, 0.03]",
       "size = [0.13, 0.04, 0.03]",
       {"feeder \"spout\" would feed grains at [", "outside the container (box)"}},
      {"total_kg = 0.5", "total_kg = 0.5\ntotal_grains = 5", {"are both given", "one of them"}},
      {"grains_per_second = 100", "grains_per_second = -1", {"feeder.grains_per_second is -1;", "grains/s"}},
      {"grains_per_second = 100\ntotal_kg = 0.5",
       "grains_per_second = 1e8",
       {"feeder \"spout\" brings the scene to", "allowed: up to 1e+06"}},
      {"size = [0.03, 0.04, 0.03]", "size = [0.03, 0.04, 0.004]", {"feeder.size[2] is 0.004; allowed: at least", "grain \"pea\""}},
      {"name = \"pea\"\nfraction", "name = \"corn\"\nfraction", {"feeder.grain.name is \"corn\"; allowed: pea, die"}},
      {"fraction = 0.25", "fraction = 0.2", {"the fractions of feeder.grain sum to 0.95; allowed: a sum of 1"}},
      {"from = 0.02", "from = 0.02\nuntil = 0.01", {"feeder.until is 0.01"}},
      {"name = \"spout\"", "name = \"a b\"", {"feeder.name is \"a b\"; allowed: letters"}},
      {"size = [0.05, 0.06, 0.01]", "size = [0.05, 0.06, 0.01]\npoint = [0, 0, 0]", {"sink.corner and sink.point are both given"}},
      {"corner = [0, 0, 0]\nsize = [0.05, 0.06, 0.01]", "point = [0, 0, 0]\nnormal = [0, 0, 0]", {"sink.normal is [0, 0, 0]"}},
      {"corner = [0, 0, 0]\nsize = [0.05, 0.06, 0.01]\n", "", {"sink.corner or sink.point is missing"}},
  };
  for (const auto& [from, to, says] : mistakes) check_says(complaint(replaced(text, from, to)), says);
  CHECK(complaint(replaced(replaced(replaced(text, "count = 5", "count = 0"), "count = 2", "count = 0"),
                           "[drop]\nheight = 0.01\ngap = 0.1\n", ""))
            .empty());
  check_says(complaint(replaced(text, "[drop]\nheight = 0.01\ngap = 0.1\n", "")), {"drop is missing"});
}
