#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "observe/bed.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;

namespace {

constexpr double kBaseRadius = 0.03;  // m, radius of the base
constexpr double kBase = 0.01;        // m, its height

GrainKind pea() { return {"pea", {2e-3, 2e-3, 2e-3}, 2, 2, 0, 1200, "test"}; }

/// The centres of balls on a cone: their envelope is a parallel cone except for the grid's ripples.
std::vector<Placement> on_a_cone(double degrees) {
  constexpr double kSpacing = 1e-3;
  const double slope = std::tan(degrees * std::numbers::pi / 180);
  std::vector<Placement> placements;
  for (int i = -30; i <= 30; ++i) {
    for (int j = -30; j <= 30; ++j) {
      const double x = i * kSpacing;
      const double y = j * kSpacing;
      const double r = std::hypot(x, y);
      if (r > kBaseRadius) continue;
      placements.push_back({0, {0.1 + x, 0.05 + y, kBase + 1e-3 + slope * (kBaseRadius - r)}, {1, 0, 0, 0}});
    }
  }
  return placements;
}

}  // namespace

TEST_CASE("the angle of a constructed cone of grains") {
  for (const double degrees : {12.0, 25.0, 40.0}) {
    CAPTURE(degrees);
    const std::vector<Placement> placements = on_a_cone(degrees);
    const Scene scene = scene_of(Box{{0.2, 0.1}}, {{pea(), static_cast<int>(placements.size())}});
    const World world(scene, placements);
    const Heap heap = measure_heap(world, {0.1, 0.05, kBase}, kBaseRadius);
    CHECK(std::abs(heap.angle - degrees) < 0.2);
    CHECK(heap.standard_error < 0.2);
    CHECK(heap.grains == placements.size());
    CHECK(heap.has_flank);
    const double tangent = std::tan(degrees * std::numbers::pi / 180);
    const double top = 1e-3 + tangent * kBaseRadius + 2e-3 * std::hypot(1, tangent);  // height of the parallel cone
    CHECK(heap.height == supernormal::test::relative(top).epsilon(0.02));
  }
}

TEST_CASE("no heap has no slope, and what lies beside or below the base does not count") {
  const Scene scene = scene_of(Box{{0.2, 0.1}}, {{pea(), 2}});
  const World world(scene, {{0, {0.05, 0.05, 0.02}, {1, 0, 0, 0}}, {0, {0.1, 0.06, 0.005}, {1, 0, 0, 0}}});
  const Heap heap = measure_heap(world, {0.1, 0.05, kBase}, kBaseRadius);
  CHECK(!heap.has_flank);
  CHECK(heap.grains == 0);
}

TEST_CASE("a dish is closed but for its foot, and holds a grain within its rim") {
  const Dish dish{.diameter = 0.06, .height = 0.02, .rim = 0.003};
  constexpr int kSides = 12;
  const Mesh mesh = make_mesh(dish, kSides);
  std::map<std::pair<unsigned int, unsigned int>, int> edges;  // directed
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{triangle[k], triangle[(k + 1) % 3]}];
  }
  int open = 0;
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    if (edges.contains({edge.second, edge.first})) continue;
    CHECK(mesh.vertices[edge.first][2] == 0);
    ++open;
  }
  CHECK(open == kSides);

  const Hopper hopper{.outlet = 0.03,
                      .wall_angle = 30,
                      .diameter = 0.05,
                      .cylinder_height = 0.05,
                      .segments = kSides,
                      .clearance = 0.05,
                      .tray_width = 0.12,
                      .opens_at = 1,
                      .dish = dish};
  const Scene scene = scene_of(hopper, {{pea(), 2}});
  // One grain rolls towards the rim, one lies in the tray.
  World world(scene, {{0, {0, 0, 0.0225}, {1, 0, 0, 0}}, {0, {0.05, 0.05, 0.003}, {1, 0, 0, 0}}});
  world.open_outlet();  // the lid is solid all the way down
  dBodySetLinearVel(world.grains()[0].body, 0.1, 0, 0);
  Stepper stepper(world, scene);
  for (int i = 0; i < 1500; ++i) {
    stepper.step();
    REQUIRE(hopper.contains(world.grains()[0].position()));
  }
  const Point rolled = world.grains()[0].position();
  CHECK(rolled[2] == supernormal::test::relative(0.022).epsilon(1e-2));
  CHECK(std::hypot(rolled[0], rolled[1]) < 0.03);
  CHECK(world.grains()[1].position()[2] == supernormal::test::relative(0.002).epsilon(1e-2));
  CHECK_FALSE(hopper.contains({0.01, 0, 0.01}));  // within the dish
}

TEST_CASE("a dish that does not fit below the outlet is refused") {
  const std::string good = std::string(kHopperText) + "\n[container.dish]\ndiameter = 0.06\nheight = 0.02\nrim = 0.002";
  CHECK(complaint(scene_in(good)).empty());
  check_says(complaint(scene_in(replaced(good, "height = 0.02", "height = 0.06"))),
             {"container.dish.height is 0.06;", "(0, 0.05)"});
  check_says(complaint(scene_in(replaced(good, "rim = 0.002", "rim = 0.04"))), {"container.dish.rim is 0.04;"});
  check_says(complaint(scene_in(replaced(good, "diameter = 0.06", "diameter = 0.2"))), {"container.dish.diameter is 0.2;"});
}
