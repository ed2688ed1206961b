#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/random.hpp"
#include "complaint.hpp"
#include "scenes.hpp"
#include "world/placement.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;

namespace {

using Pairs = std::set<std::pair<dGeomID, dGeomID>>;

void insert(void* pairs, dGeomID g1, dGeomID g2) { static_cast<Pairs*>(pairs)->insert(std::minmax(g1, g2)); }

Pairs named_pairs(const World& world) {
  Pairs pairs;
  world.name_pairs(&pairs, insert);
  return pairs;
}

bool boxes_meet(dGeomID g1, dGeomID g2) {
  dReal box1[6];
  dReal box2[6];
  dGeomGetAABB(g1, box1);
  dGeomGetAABB(g2, box2);
  for (int axis = 0; axis < 3; ++axis) {
    if (box1[2 * axis] > box2[2 * axis + 1] || box2[2 * axis] > box1[2 * axis + 1]) return false;
  }
  return true;
}

Pairs all_pairs(const World& world) {
  std::vector<dGeomID> geoms = world.walls().geoms();
  const std::size_t walls = geoms.size();
  for (const Grain& grain : world.grains()) geoms.push_back(grain.geom);
  Pairs pairs;
  for (std::size_t i = walls; i < geoms.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (boxes_meet(geoms[i], geoms[j])) pairs.insert(std::minmax(geoms[i], geoms[j]));
    }
  }
  return pairs;
}

Scene scene_of_peas(int count) { return scene_of(replaced(kSceneText, "count = 5", "count = " + std::to_string(count))); }

/// A world with the same grains in the same places.
World make_world(const Scene& scene) {
  Random random(1);
  return World(scene, place(scene, random));
}

/// Scatters grains in a box of these sides above the floor, close enough to meet.
void scatter(const World& world, const Point& sides) {
  Random random(2);
  for (const Grain& grain : world.grains()) {
    const double x = sides[0] * random.uniform();
    const double y = sides[1] * random.uniform();
    dBodySetPosition(grain.body, x, y, sides[2] * random.uniform());
  }
}

}  // namespace

TEST_CASE("the broad phase names every pair whose bounding boxes meet, whatever its axis") {
  Scene scene = scene_of_peas(200);
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    scene.sweep_axis = axis;
    const World world = make_world(scene);
    CHECK(world.sweep().axis() == axis);
    scatter(world, {0.05, 0.06, 0.03});
    const Pairs pairs = named_pairs(world);
    CHECK(pairs.size() > 300);
    CHECK(pairs == all_pairs(world));
    world.sweep().before_step();
    CHECK(world.sweep().axis() == axis);
  }
}

TEST_CASE("the sweep is along the axis of the largest spread, also after it changes") {
  const Scene scene = scene_of_peas(200);
  const World world = make_world(scene);
  struct Bed {
    Point sides;
    Axis axis;
  };
  const std::vector<Bed> beds = {
      {{0.01, 0.01, 1}, Axis::Z}, {{1, 0.1, 0.1}, Axis::X}, {{0.1, 1, 0.1}, Axis::Y}, {{1, 1.1, 0.1}, Axis::Y}};
  for (const Bed& bed : beds) {
    CAPTURE(name_of(bed.axis));
    scatter(world, bed.sides);
    for (int step = 0; step < 100; ++step) world.sweep().before_step();
    CHECK(world.sweep().axis() == bed.axis);
    CHECK(named_pairs(world) == all_pairs(world));
  }
}

TEST_CASE("a scene may fix the axis of the sweep") {
  CHECK(scene_of(std::string(kSceneText) + "[broad_phase]\naxis = \"y\"\n").sweep_axis == Axis::Y);
  CHECK_FALSE(scene_of(kSceneText).sweep_axis);
  check_says(complaint(std::string(kSceneText) + "[broad_phase]\naxis = \"w\"\n"),
             {"scene.toml:32: broad_phase.axis is \"w\"", "allowed: x, y, z"});
  check_says(complaint(std::string(kSceneText) + "[broad_phase]\nspace = \"hash\"\n"),
             {"scene.toml:32: unknown key \"space\" in [broad_phase]", "allowed: axis"});
}

TEST_CASE("a broad phase that finds no pairs is timed") {
  const Scene scene = scene_of_peas(5000);
  const World world = make_world(scene);
  Stepper stepper(world, scene);
  for (int step = 0; step < 5; ++step) stepper.step();
  const StepCosts& costs = stepper.costs();
  CHECK(costs.pairs_tested == 0);
  CHECK(costs.broad_phase.seconds() > 0.5 * costs.collision.seconds());
}
