#include "model/container.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "observe/energy.hpp"
#include "observe/leaks.hpp"
#include "observe/simulation.hpp"
#include "scenes.hpp"
#include "world/placement.hpp"
#include "world/world.hpp"

using namespace falling_particles;

TEST_CASE("a box is open at the top only") {
  const Container box = Box{{0.2, 0.3}};
  CHECK(contains(box, {0.1, 0.29, 1e-9}));
  CHECK(contains(box, {0.1, 0.1, 1e6}));
  CHECK_FALSE(contains(box, {0.1, 0.31, 0.1}));
  CHECK_FALSE(contains(box, {0, 0.1, 0.1}));
  CHECK_FALSE(contains(box, {0.1, 0.1, -1e-9}));
  CHECK_FALSE(contains(box, {0.1, 0.1, INFINITY}));
  CHECK_FALSE(contains(box, {0.1, NAN, 0.1}));
  CHECK_FALSE(contains(box, {0.1, 0.1, NAN}));
}

TEST_CASE("the room of a container is the smallest box around it") {
  const Hopper hopper{0.05, 30, 0.1, 0.1, 12, 0.05, 0.15, 0};
  const std::vector<Container> containers = {Box{{0.2, 0.3}}, hopper, Terrain({{0.2, 0.3}, 0.01, 0.1, 0.02, 21, 3}),
                                             Open{{{0, 0, 0}, {0.1, 0.1, 0.1}}, {{-0.2, -0.1, -0.05}, {0.5, 0.3, 0.4}}},
                                             Drum{0.2, 0.1, 12, 30, 0}};
  Random random(5);
  for (const Container& container : containers) {
    CAPTURE(kind_of(container));
    const Region room = room_of(container);
    Point least = {1, 1, 1}, most = {-1, -1, -1};
    for (int i = 0; i < 100000; ++i) {
      const Point point = {random.uniform() * 1.2 - 0.5, random.uniform() * 1.2 - 0.5, random.uniform() * 0.7 - 0.1};
      if (!contains(container, point)) continue;
      CHECK(room.contains(point));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        least[axis] = std::min(least[axis], point[axis]);
        most[axis] = std::max(most[axis], point[axis]);
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double slack = 0.1 * (most[axis] - least[axis]);
      CHECK(least[axis] - room.corner[axis] < slack);
      if (std::isfinite(room.size[axis])) CHECK(room.corner[axis] + room.size[axis] - most[axis] < slack);
    }
  }
}

TEST_CASE("the values of hoppers and terrains are read") {
  const Scene with_hopper = scene_of(scene_in(kHopperText));
  CHECK(std::string(kind_of(with_hopper.container)) == "hopper");
  const auto& hopper = std::get<Hopper>(with_hopper.container);
  CHECK(hopper.outlet == 0.05);
  CHECK(hopper.wall_angle == 30);
  CHECK(hopper.diameter == 0.1);
  CHECK(hopper.cylinder_height == 0.1);
  CHECK(hopper.segments == 12);
  CHECK(hopper.clearance == 0.05);
  CHECK(hopper.tray_width == 0.15);
  CHECK(hopper.opens_at == 0.05);
  const Scene with_terrain = scene_of(scene_in(kTerrainText));
  CHECK(std::string(kind_of(with_terrain.container)) == "terrain");
  const TerrainParameters& terrain = std::get<Terrain>(with_terrain.container).parameters();
  CHECK(terrain.width == std::array<double, 2>{0.05, 0.06});
  CHECK(terrain.amplitude == 0.004);
  CHECK(terrain.wavelength == 0.03);
  CHECK(terrain.ridge_height == 0.002);
  CHECK(terrain.samples == 21);
  CHECK(terrain.seed == 3);
}

TEST_CASE("every mistake in a hopper ends with one line: file, line, what is allowed") {
  const std::vector<Mistake> in_hoppers = {
      {"outlet = 0.05", "outlet = 0.1", {"scene.toml:7: container.diameter is 0.1;", "(0.1, 1000] m (above container.outlet)"}},
      {"diameter = 0.1", "diameter = 0.052", {"scene.toml:7: container.diameter is 0.052;", "at least 0.05", "lattice"}},
      {"tray_width = 0.15", "tray_width = 0.1", {"scene.toml:11: container.tray_width is 0.1;", "[0.103"}},
      {"opens_at = 0.05", "opens_at = 0.1", {"scene.toml:12: container.opens_at is 0.1;", "(0, 0.1) s"}},
      {"opens_at = 0.05", "opens_at = 0", {"scene.toml:12: container.opens_at is 0;", "(0, 0.1) s", "0 only with [start]"}},
      {"opens_at = 0.05", "", {"scene.toml:3: container.opens_at is missing;", "(0, 0.1) s"}},
  };
  for (const Mistake& mistake : in_hoppers) {
    check_says(complaint(scene_in(replaced(kHopperText, mistake.from, mistake.to))), mistake.says);
  }
}

TEST_CASE("a cylinder that is too low for the grains is refused, with the least height") {
  const std::string many = replaced(scene_in(kHopperText), "count = 5", "count = 200");
  const std::string said = complaint(many);
  check_says(said, {"scene.toml:8: container.cylinder_height is 0.1; allowed: at least "});
  const std::string least = said.substr(said.find("at least ") + 9, said.find(" m, so") - said.find("at least ") - 9);
  const double height = std::stod(least);
  CHECK(height > 0.1);
  CHECK(complaint(replaced(many, "cylinder_height = 0.1", "cylinder_height = " + std::to_string(height + 1e-5))).empty());
  CHECK_FALSE(complaint(replaced(many, "cylinder_height = 0.1", "cylinder_height = " + std::to_string(height - 1e-5))).empty());
}

TEST_CASE("grains start within their container, clear of its walls") {
  for (const std::string container : {kHopperText, kTerrainText}) {
    CAPTURE(container);
    const Scene scene = scene_of(replaced(scene_in(container), "count = 5", "count = 12"));
    Random random(5);
    for (const Placement& p : place(scene, random)) {
      const double radius = scene.kinds[p.kind].kind.bounding_radius() * (1 - 1e-12);
      constexpr int kDirections = 200;
      for (int i = 0; i < kDirections; ++i) {
        // The points cover the bounding sphere, by the golden angle.
        const double z = 1 - (2 * i + 1.0) / kDirections;
        const double around = 2.39996322972865332 * i;
        const double r = std::sqrt(1 - z * z);
        CHECK(contains(scene.container, {p.position[0] + radius * r * std::cos(around),
                                         p.position[1] + radius * r * std::sin(around), p.position[2] + radius * z}));
      }
    }
  }
}

TEST_CASE("a leak is counted once") {
  Scene scene = scene_of(kSceneText);
  scene.kinds[0].count = 2;
  scene.kinds.resize(1);
  const World world(scene, {{0, {0.02, 0.02, 0.02}, {1, 0, 0, 0}}, {0, {0.04, 0.04, 0.02}, {1, 0, 0, 0}}});
  LeakWatch watch(world);
  watch.after_step(0.1);
  CHECK(watch.count() == 0);
  CHECK_FALSE(watch.first());
  dBodySetPosition(world.grains()[1].body, 0.04, -0.001, 0.02);
  watch.after_step(0.2);
  watch.after_step(0.3);
  dBodySetPosition(world.grains()[1].body, 0.04, 0.04, 0.02);
  watch.after_step(0.4);
  CHECK(watch.count() == 1);
  REQUIRE(watch.first());
  CHECK(watch.first()->grain == 1);
  CHECK(watch.first()->time == 0.2);
  CHECK(describe(*watch.first()) ==
        "grain 1 (pea) left the container at t = 0.2 s: position [0.04, -0.001, 0.02] m, quaternion [1, 0, 0, 0], velocity [0, 0, "
        "0] m/s");
  dBodySetPosition(world.grains()[0].body, 0.02, 0.02, -1);
  watch.after_step(0.5);
  CHECK(watch.count() == 2);
  CHECK(watch.first()->grain == 1);
}

namespace {

/// A pea within bounds of 18 m, in a scene without walls but its parts and sinks.
Scene in_bounds(const std::string& parts, const std::string& gravity = "[0, 0, -9.81]") {
  const std::string text = replaced(kSceneText, "kind = \"box\"\nwidth = [0.05, 0.06]\n",
                                    "kind = \"none\"\nstart = { corner = [0, 0, 0], size = [0.05, 0.06, 0.5] }\n"
                                    "bounds = { corner = [-9, -9, -9], size = [18, 18, 18] }\n");
  return scene_of(replaced(text, "[0, 0, -9.81]", gravity) + parts);
}

bool has_leaked(const Scene& scene, const Point& at) {
  const World world(scene, {{0, at, {1, 0, 0, 0}}});
  LeakWatch watch(world);
  watch.after_step(0.1);
  CHECK(count_outside(world) == watch.count());
  return watch.count() > 0;
}

}  // namespace

TEST_CASE("grains below all parts of an open container have leaked, as far as nothing can stop them") {
  const double radius = 3e-3;
  const std::string plate = "[[part]]\nname = \"plate\"\nshape = \"box\"\nsize = [0.1, 0.1, 0.02]\nposition = [0, 0, -0.01]\n";
  const Scene scene = in_bounds(plate);
  CHECK_FALSE(has_leaked(scene, {1, 0, -0.02 - 0.999 * radius}));
  CHECK(has_leaked(scene, {1, 0, -0.02 - 1.001 * radius}));
  CHECK(has_leaked(scene, {10, 0, 1}));
  CHECK_FALSE(has_leaked(in_bounds(plate, "[0, 0, 0]"), {0, 0, -5}));
  const Scene upwards = in_bounds(plate, "[0, 0, 1]");
  CHECK_FALSE(has_leaked(upwards, {0, 0, -5}));
  CHECK(has_leaked(upwards, {0, 0, 1.001 * radius}));

  const auto sloping = [](const char* angle) {
    return std::string("[[part]]\nname = \"plane\"\nshape = \"plane\"\nposition = [0, 0, -8]\naxis = [0, 1, 0]\nangle = ") + angle +
           "\n";
  };
  CHECK_FALSE(has_leaked(in_bounds(plate + sloping("80")), {1, 0, -1}));
  CHECK(has_leaked(in_bounds(plate + sloping("100")), {1, 0, -1}));  // an overhang

  const std::string upright = "[[part]]\nname = \"side\"\nshape = \"plane\"\nposition = [2, 0, 0]\naxis = [0, 1, 0]\nangle = -90\n";
  CHECK_FALSE(has_leaked(in_bounds(plate + upright), {1.999, 0, 1}));
  CHECK(has_leaked(in_bounds(plate + upright), {2.001, 0, 1}));
  CHECK(has_leaked(in_bounds(plate + upright, "[0, 0, 0]"), {2.001, 0, 1}));
  const std::string beyond = "[[sink]]\nname = \"s\"\ncorner = [2, -1, 0]\nsize = [1, 2, 2]\n";
  CHECK_FALSE(has_leaked(in_bounds(plate + upright + beyond), {2.001, 0, 1}));

  const std::string box = "[[sink]]\nname = \"s\"\ncorner = [0, 0, -2]\nsize = [0.1, 0.1, 0.1]\n";
  CHECK_FALSE(has_leaked(in_bounds(plate + box), {1, 0, -1}));
  CHECK(has_leaked(in_bounds(plate + box), {1, 0, -2.1}));
  CHECK_FALSE(has_leaked(in_bounds(plate + "[[sink]]\nname = \"s\"\npoint = [0, 0, -8]\nnormal = [0, 0, 1]\n"), {1, 0, -7}));
}

TEST_CASE("a free part that falls past all other parts takes no grain with it") {
  const auto leaked = [](const std::string& more) {
    Scene scene = in_bounds(
        "[[part]]\nname = \"tray\"\nshape = \"box\"\nsize = [0.1, 0.1, 0.02]\nposition = [0, 0, -0.01]\n"
        "free = { mass = 1, from = 0.02 }\n" +
        more);
    scene.start = StartState{.overlap = 0.1, .grains = {{.position = {0, 0, 3e-3}}}};
    Simulation simulation(scene, 1);
    std::vector<std::size_t> counts;
    for (int i = 1; i <= 400; ++i) {
      simulation.advance(i * scene.time.step);
      if (i == 39 || i == 400) counts.push_back(simulation.watches.leaks.count());
    }
    CHECK(free_walls_outside(simulation.world).size() == counts.back());
    return counts;
  };
  const std::string post = "[[part]]\nname = \"post\"\nshape = \"box\"\nsize = [0.02, 0.02, 0.1]\nposition = ";
  CHECK(leaked("") == std::vector<std::size_t>{0, 1});                          // the tray is held until 0.02 s
  CHECK(leaked(post + "[0.5, 0, -0.1]\n") == std::vector<std::size_t>{0, 1});   // beside the tray
  CHECK(leaked(post + "[0, 0, -0.0701]\n") == std::vector<std::size_t>{0, 0});  // below the tray
}
