// Tests of what a scene is refused for or asked about before it runs.
#include "run/doubts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/interval.hpp"
#include "complaint.hpp"
#include "model/grain_shape.hpp"
#include "observe/overlap.hpp"
#include "observe/simulation.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/placement.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

Scene with_part(const std::string& part) { return scene_of(std::string(kSceneText) + "[[part]]\nname = \"p\"\n" + part); }

/// A scene whose walls are parts.
Scene in_open(const std::string& rest) {
  return scene_of(replaced(kSceneText, "kind = \"box\"\nwidth = [0.05, 0.06]\n",
                           "kind = \"none\"\nstart = { corner = [0, 0, 0], size = [0.05, 0.06, 0.5] }\n"
                           "bounds = { corner = [-9, -9, -9], size = [18, 18, 18] }\n") +
                  rest);
}

void check_one_doubt(const Scene& scene, const std::vector<const char*>& says) {
  const std::vector<std::string> doubts = doubts_about(scene);
  REQUIRE(doubts.size() == 1);
  check_says(doubts.front(), says);
}

/// A cell with these keys around the scene's start.
Scene in_cell(const std::string& keys, const std::vector<std::string>& overrides = {}) {
  return scene_of(replaced(kSceneText, "kind = \"box\"\nwidth = [0.05, 0.06]\n",
                           "kind = \"cell\"\nwidth = [0.05, 0.06]\nheight = 0.07\n" + keys),
                  overrides);
}

std::string on_all_sides(const std::string& drive) {
  std::string keys;
  for (const char* side : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"}) keys.append(side).append(drive);
  return keys;
}

/// A box without a lid around the scene's start, whose triangles are seen from inside or from outside.
Scene in_mesh(bool from_inside) {
  Scene scene = scene_of(std::string(kSceneText));
  MeshShape mesh;
  for (const float z : {0.001F, 0.5F}) {
    for (const auto& [x, y] : {std::pair{0.F, 0.F}, {0.05F, 0.F}, {0.05F, 0.06F}, {0.F, 0.06F}}) mesh.vertices.push_back({x, y, z});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned next = (i + 1) % 4;
    mesh.triangles.push_back({next, i, i + 4});
    mesh.triangles.push_back({next, i + 4, next + 4});
  }
  if (!from_inside) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  }
  scene.walls.push_back({"bin", mesh});
  return scene;
}

}  // namespace

TEST_CASE("doubts: a scene that means what it says has none") {
  CHECK(doubts_about(scene_of(std::string(kSceneText))).empty());
  refuse_overlapping_start(scene_of(std::string(kSceneText)));
}

TEST_CASE("doubts: a duration and a frame that are no multiples of the step are rounded, and said to be") {
  check_one_doubt(scene_of(replaced(kSceneText, "duration = 0.1", "duration = 0.1003")),
                  {"time.duration is 0.1003 s", "rounded to 201 steps", "a multiple of 5e-04 s"});
  check_one_doubt(scene_of(replaced(kSceneText, "frame = 0.01", "frame = 0.0013")),
                  {"time.frame is 0.0013 s", "rounded to 3 steps"});
}

TEST_CASE("doubts: the fall from the start is compared with the step") {
  Scene scene = scene_of(std::string(kSceneText));
  const std::optional<Fall> low = fall_from_start(scene);
  REQUIRE(low);
  CHECK(low->height > 0.01 + 2 * 6e-3);
  CHECK(low->speed == relative(std::sqrt(2 * 9.81 * low->height)).epsilon(1e-12));
  CHECK(low->way == relative(scene.time.step * low->speed).epsilon(1e-12));
  scene.drop.height = 300;
  check_one_doubt(scene,
                  {"from the start grains fall up to 300 m", "76.7 m/s", "of the smallest half-axis (0.003 m)", "time.step up to"});
}

TEST_CASE("doubts: grains fall along gravity, to the end of the container") {
  const auto with = [](const Container& container, const supernormal::Vector3& acceleration) {
    Scene scene = scene_of(container, {{ball(), 1}});
    for (auto& effect : scene.effects) {
      if (auto* const gravity = std::get_if<supernormal::effects::Gravity>(&effect)) gravity->acceleration = acceleration;
    }
    return scene;
  };
  const Cell cell{{{{0, 0, 0}, {0.2, 0.1, 40}}, {{-99, -99, -99}, {198, 198, 198}}}};
  const double down = fall_from_start(with(cell, {0, 0, -9.81}))->height, up = fall_from_start(with(cell, {0, 0, 9.81}))->height;
  CHECK(down < 0.05);
  CHECK(up > 39.9);
  CHECK(fall_from_start(with(cell, {3, 0, 0}))->height == relative(0.2).epsilon(1e-12));
  CHECK(fall_from_start(with(cell, {0, 3, 4}))->height == relative(0.6 * 0.1 + 0.8 * up).epsilon(1e-12));
  CHECK(doubts_about(with(cell, {0, 0, -9.81})).empty());
  check_one_doubt(with(cell, {0, 0, 9.81}), {"from the start grains fall up to ", "28 m/s", "time.step up to"});
  CHECK(!fall_from_start(with(Box{{0.1, 0.1}}, {0, 0, 9.81})));  // out of the box
}

TEST_CASE("doubts: a scene without gravity in which nothing moves") {
  Scene scene = scene_of(Box{{0.1, 0.1}}, {{ball(), 1}});
  std::erase_if(scene.effects, [](const auto& effect) { return std::holds_alternative<supernormal::effects::Gravity>(effect); });
  check_one_doubt(scene, {"the scene has no section [gravity]"});
  scene.feeders.emplace_back();
  for (const std::string& doubt : doubts_about(scene)) CHECK(doubt.find("[gravity]") == std::string::npos);
}

TEST_CASE("doubts: grains fall out of a hopper to its tray") {
  const auto height_in = [](const Container& container) { return fall_from_start(scene_of(container, {{ball(), 1}}))->height; };
  const auto hopper = [](double clearance) {
    return Hopper{.outlet = 0.04,
                  .wall_angle = 30,
                  .diameter = 0.08,
                  .cylinder_height = 0.1,
                  .segments = 12,
                  .clearance = clearance,
                  .tray_width = 0.2,
                  .opens_at = 0.1};
  };
  CHECK(height_in(hopper(0.1)) > 0.1);
  CHECK(height_in(hopper(2)) == relative(height_in(hopper(0.1)) + 1.9).epsilon(1e-12));
  Scene scene = scene_of(hopper(300), {{ball(), 1}});
  check_one_doubt(scene, {"grains fall up to 300 m", "without drag its last grains fall with 76.", "time.step up to"});
}

TEST_CASE("doubts: a step in which grains fall far from rest is named, and a longer one is allowed to grains that look ahead") {
  const auto with = [](bool looks_ahead, double way) {  // in half-axes
    Scene scene = scene_of(Box{{0.1, 0.1}}, {{ball(), 1}});
    scene.start = StartState{.grains = {{.position = {0.05, 0.05, 0.005}}}};
    scene.time.step = std::sqrt(way * 5e-3 / 9.81);
    scene.time.frame = scene.time.duration = 100 * scene.time.step;
    if (looks_ahead) scene.effects.back() = supernormal::effects::SpeculativeContacts{};
    return scene;
  };
  CHECK(doubts_about(with(false, 0.099)).empty());
  check_one_doubt(with(false, 0.8), {"from rest, grains fall 0.004 m in a step, 0.8 of the smallest half-axis (0.005 m)",
                                     "time.step up to 0.00714 s would do"});
  CHECK(doubts_about(with(true, 9.9)).empty());
  check_one_doubt(with(true, 10.1), {"from rest, grains fall 0.0505 m", "time.step up to 0.0714 s would do"});
}

TEST_CASE("doubts: a part whose surface moves by more than a half-axis in a step may pass through grains") {
  const std::string paddle = "shape = \"box\"\nsize = [0.01, 0.04, 0.04]\nposition = [1, 0, 1]\n[[part.motion]]\n";
  check_one_doubt(with_part(paddle + "kind = \"velocity\"\nvelocity = [1000, 0, 0]\n"), {"part \"p\" moves 0.5 m in a step"});
  CHECK(doubts_about(with_part(paddle + "kind = \"velocity\"\nvelocity = [5, 0, 0]\n")).empty());
  check_one_doubt(with_part(paddle + "kind = \"vibration\"\ndirection = [1, 0, 0]\namplitude = 0.01\nfrequency = 200\n"),
                  {"part \"p\" moves"});
  check_one_doubt(with_part(paddle + "kind = \"rotation\"\naxis = [0, 1, 0]\npoint = [0, 0, 0]\nrpm = 300\n"),
                  {"part \"p\" moves"});
  // A shaft turns in its own place, however fast, and a turntable in its own plane.
  const std::string spin = "[[part.motion]]\nkind = \"rotation\"\naxis = [0, 0, 1]\npoint = [1, 0, 1]\nrpm = 3000\n";
  CHECK(doubts_about(with_part("shape = \"cylinder\"\nradius = 0.02\nlength = 0.1\nposition = [1, 0, 1]\n" + spin)).empty());
  CHECK(doubts_about(with_part("shape = \"plane\"\nposition = [0, 0, -1]\n" + spin)).empty());
}

TEST_CASE("doubts: a driven part that jumps over a half-axis in its first step is named, and one without mass refused") {
  const std::string lid =
      "shape = \"box\"\nsize = [0.04, 0.04, 0.01]\nposition = [0.025, 0.03, 1]\n[part.drive]\naxis = [0, 0, -1]\nforce = 10\n";
  check_one_doubt(with_part(lid + "mass = 1e-6\n"),
                  {"part \"p\" is driven 2.5 m in a step", "part.drive.mass from 0.000833 kg on"});
  CHECK(doubts_about(with_part(replaced(lid, "force = 10", "force = 0.05") + "mass = 0.01\n")).empty());
  std::string all;
  for (const std::string& doubt :
       doubts_about(with_part(replaced(lid, "force = 10", "pressure = 1e9\narea = 100") + "mass = 0.01\n"))) {
    all += doubt;
  }
  check_says(all, {"part \"p\" is driven 2.5e+06 m in a step", "a smaller force would do"});
  check_says(complaint(std::string(kSceneText) + "[[part]]\nname = \"p\"\n" + lid + "mass = 1e-160\n"),
             {"part.drive.mass is 1e-160; allowed: a number in [1e-12, 1e+06] kg"});
}

TEST_CASE("doubts: a driven part that jumps over a half-axis when it meets the first grain is named") {
  // The grains start at [0.02, 0.02, 0.1], and 0.006 m is the largest bounding radius of a sphere about them.
  const auto driven = [](const std::string& rest) {
    Scene scene = with_part(
        "shape = \"box\"\nsize = [0.04, 0.04, 0.01]\nposition = [0.025, 0.03, 1]\n[part.drive]\naxis = [0, 0, -1]\n" + rest);
    scene.start = StartState{.grains = {{.position = {0.02, 0.02, 0.1}}}};
    return scene;
  };
  const double way = 1 - 0.005 - 0.1 - driven("force = 1\nmass = 1\n").largest_bounding_radius();
  const double force = 0.01 * (std::pow(3e-3 / 5e-4, 2) / (2 * way) - 9.81);  // N on 10 g, for 6 m/s
  CHECK(doubts_about(driven("mass = 0.01\nforce = " + shortest(0.99 * force) + "\n")).empty());
  check_one_doubt(driven("mass = 0.01\nforce = " + shortest(1.02 * force) + "\n"),
                  {"part \"p\" is driven up to the first grain with 6.0", "m/s, 0.003", "time.step up to"});
  CHECK(doubts_about(driven("mass = 0.01\ntravel = [0, 0.5]\nforce = " + shortest(1.02 * force) + "\n")).empty());
  CHECK(doubts_about(driven("mass = 0.01\ndamping = 1\nforce = " + shortest(1.02 * force) + "\n")).empty());
  CHECK(doubts_about(driven("mass = 0.01\npower = 0.1\nlargest_force = " + shortest(1.02 * force) + "\n")).empty());
}

TEST_CASE("doubts: a part that a torque or a servo moves by more than a half-axis in a step is named") {
  const std::string door =
      "shape = \"box\"\nsize = [0.04, 0.04, 0.01]\nposition = [0.025, 0.03, 1]\n[part.drive]\naxis = [0, 0, 1]\n"
      "torque = 10\npoint = [0.025, 0.03, 0]\n";
  check_one_doubt(with_part(door + "moment = 1e-6\n"), {"part \"p\" is driven", "part.drive.moment from", "kg m^2 on"});
  CHECK(doubts_about(with_part(door + "moment = 1\n")).empty());
  const std::string servo =
      "shape = \"box\"\nsize = [0.04, 0.04, 0.01]\nposition = [0.025, 0.03, 1]\n[part.drive]\naxis = [0, 0, -1]\nstress = 1000\n"
      "gain = 1\n";
  check_one_doubt(with_part(servo + "largest_speed = 10\n"),
                  {"part \"p\" is driven 0.005 m in a step", "part.drive.largest_speed up to 6 m/s"});
  CHECK(doubts_about(with_part(servo + "largest_speed = 1\n")).empty());
  // On springs the gain has a limit: 4 x (0.006 m)^2 / (10 N/m x 5e-4 s).
  const auto on_springs = [&](const char* gain) {
    const std::string text = replaced(kSceneText, "[max_correcting_velocity]\nvelocity = 0.05\n", "[compliance]\nstiffness = 10\n");
    return scene_of(text + "[[part]]\nname = \"p\"\n" +
                    replaced(replaced(servo, "gain = 1\n", gain), "stress = 1000", "stress = 1") + "largest_speed = 1\n");
  };
  check_one_doubt(on_springs("gain = 0.03\n"),
                  {"part \"p\" is a servo with a gain of 0.03 m/(s Pa)", "part.drive.gain up to 0.0288 m/(s Pa)"});
  CHECK(doubts_about(on_springs("gain = 0.028\n")).empty());
}

TEST_CASE("doubts: a grain may not start inside a part") {
  const std::string shapes[] = {"shape = \"box\"\nsize = [0.1, 0.1, 0.1]\n", "shape = \"cylinder\"\nradius = 0.1\nlength = 0.1\n",
                                "shape = \"ellipsoid\"\nhalf_axes = [0.1, 0.1, 0.1]\n",
                                "shape = \"plane\"\nposition = [0, 0, 0.05]\n"};
  for (const std::string& shape : shapes) {
    CAPTURE(shape);
    std::string text;
    try {
      refuse_overlapping_start(with_part(shape));
    } catch (const InputError& error) {
      text = error.what();
    }
    check_says(text, {"starts at [", "deep in part \"p\"; allowed: walls that leave the start of the grains free"});
  }
  refuse_overlapping_start(with_part("shape = \"plane\"\nposition = [0, 0, 0.009]\n"));
}

TEST_CASE("doubts: a mesh does not hold what falls on the backs of its triangles") {
  CHECK(doubts_about(in_mesh(true)).empty());
  check_one_doubt(in_mesh(false), {"part \"bin\": 7 of 7 grains start behind a triangle", "part.two_sided = true"});
  Scene without_floor = in_mesh(false);  // whose walls alone are turned around, above the container's floor
  auto& walls = std::get<MeshShape>(without_floor.walls.back().shape);
  walls.triangles.erase(walls.triangles.begin(), walls.triangles.begin() + 2);
  check_one_doubt(without_floor, {"part \"bin\": 7 of 7 grains start behind a triangle"});
  Scene two_sided = in_mesh(false);
  std::get<MeshShape>(two_sided.walls.back().shape).two_sided = true;
  CHECK(doubts_about(two_sided).empty());
  for (const bool from_inside : {true, false}) {  // nothing else is below the grains
    Scene alone = in_open("[[part]]\nname = \"p\"\nshape = \"plane\"\n");
    alone.walls = {in_mesh(from_inside).walls.back()};
    std::get<MeshShape>(alone.walls[0].shape).two_sided = true;
    CHECK(doubts_about(alone).empty());
  }
}

TEST_CASE("doubts: a feeder that no grain is due from, or that throws too fast") {
  const std::string feeder =
      std::string(kSceneText) + "[[feeder]]\nname = \"f\"\ncorner = [0, 0, 0.1]\nsize = [0.05, 0.06, 0.05]\n";
  check_one_doubt(scene_of(feeder + "grains_per_second = 5\n"), {"feeder \"f\" feeds nothing", "5 grains/s"});
  check_one_doubt(scene_of(feeder + "grains_per_second = 100\nvelocity = [0, 0, -500]\n"), {"grains of feeder \"f\" move 0.25 m"});
  CHECK(doubts_about(scene_of(feeder + "grains_per_second = 100\n")).empty());
}

TEST_CASE("doubts: a feeder whose grains have no room, or fall beside everything") {
  const auto fed = [](const std::string& corner, const std::string& part, const std::string& more = "") {
    return in_open("[[feeder]]\nname = \"f\"\ncorner = " + corner + "\nsize = [0.05, 0.06, 0.05]\ngrains_per_second = 100\n" +
                   more + "[[part]]\nname = \"p\"\n" + part);
  };
  const std::string floor = "shape = \"box\"\nsize = [1, 1, 0.1]\nposition = [0, 0, -0.05]\n";
  CHECK(doubts_about(fed("[0, 0, 0.2]", floor)).empty());
  check_one_doubt(fed("[0, 0, -1]", floor), {"grains that feeder \"f\" brings are above nothing"});
  check_one_doubt(fed("[0.6, 0, 0.2]", floor), {"grains that feeder \"f\" brings are above nothing"});
  CHECK(doubts_about(fed("[0.6, 0, 0.2]", floor, "velocity = [-1, 0, 0]\n")).empty());
  CHECK(doubts_about(fed("[0, 0, -1]", floor, "[[sink]]\nname = \"s\"\npoint = [0, 0, -2]\nnormal = [0, 0, 1]\n")).empty());
  const std::string thick = "shape = \"box\"\nsize = [1, 1, 2]\nposition = [0, 0, -1]\n";
  check_one_doubt(fed("[0, 0, -1]", thick), {"feeder \"f\" has no room for grain", "part \"p\" is wherever it would come"});
  check_one_doubt(fed("[0, 0, -1]", "shape = \"plane\"\n"), {"feeder \"f\" has no room for grain", "part \"p\""});
}

TEST_CASE("doubts: grains that start above nothing") {
  check_one_doubt(in_open("[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [1, 1, 0.1]\nposition = [3, 0, -0.05]\n"),
                  {"7 of 7 grains start above nothing"});
}

TEST_CASE("doubts: grains of a start or a feeder that are partly above nothing are counted, with what their width may catch") {
  // Grains start from x = 0 to 50 mm. The plate ends within, and a grate has bars nearer to each other than a pea is wide.
  const auto plate = [](double end) {
    return "[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [1, 1, 0.1]\nposition = [" + shortest(end - 0.5) + ", 0, -0.05]\n";
  };
  const auto lost = [&](double end) {
    const std::vector<std::string> doubts = doubts_about(in_open(plate(end)));
    if (doubts.empty()) return 0;
    check_says(doubts.front(), {" of 7 grains start", " above nothing", " out of it unless other grains are in the way"});
    return static_cast<int>(std::stod(doubts.front()));
  };
  const Scene scene = in_open(plate(1));
  Random random(scene.seed);
  std::vector<double> ends;  // m, of the grains against x
  for (const Placement& at : place(scene, random)) {
    ends.push_back(at.position[0] - scene.kinds[at.kind].kind.bounding_radius());
  }
  for (const double end : {0.01, 0.02, 0.03, 0.05}) {
    CAPTURE(end);
    CHECK(lost(end) == std::ranges::count_if(ends, [&](double from) { return from > end; }));
  }
  std::string grate;
  for (int i = 0; i < 16; ++i) {
    grate += "[[part]]\nname = \"bar" + std::to_string(i) + "\"\nshape = \"box\"\nsize = [0.0015, 1, 0.01]\nposition = [" +
             shortest(0.0045 * i - 0.005) + ", 0, -0.02]\n";
  }
  CHECK(doubts_about(in_open(grate)).empty());
  const std::string feeder = "[[feeder]]\nname = \"f\"\ncorner = [0, 0, 0.6]\nsize = [0.1, 0.06, 0.05]\ngrains_per_second = 100\n";
  const std::vector<std::string> doubts = doubts_about(in_open(feeder + plate(0.07)));
  REQUIRE(doubts.size() == 1);
  check_says(doubts.front(), {"some grains that feeder \"f\" brings are above nothing"});
}

TEST_CASE("doubts: sinks that take grains where they come, and parts that no grain meets") {
  const std::string text = kSceneText;
  check_one_doubt(scene_of(text + "[[sink]]\nname = \"s\"\ncorner = [-1, -1, -1]\nsize = [2, 2, 2]\n"),
                  {"7 of 7 grains start within sinks, which take them at once"});
  const std::string feeder = "[[feeder]]\nname = \"f\"\ncorner = [0, 0, 0.1]\nsize = [0.05, 0.06, 0.05]\ngrains_per_second = 100\n";
  check_one_doubt(scene_of(text + feeder + "[[sink]]\nname = \"s\"\npoint = [0, 0, 0.2]\nnormal = [0, 0, -1]\n" +
                           "[[sink]]\nname = \"t\"\ncorner = [-1, -1, 0.09]\nsize = [2, 2, 0.1]\n"),
                  {"grains that feeder \"f\" brings are within sinks"});
  const std::string box = "shape = \"box\"\nsize = [0.02, 0.02, 0.02]\n";
  check_one_doubt(with_part(box + "position = [0.02, 0.02, -0.5]\n"), {"part \"p\" stands outside the box"});
  check_one_doubt(with_part(box + "position = [0.5, 0.02, 0.02]\n"), {"part \"p\" stands outside the box"});
  CHECK(doubts_about(with_part(box + "position = [0.055, 0.02, 0.5]\n")).empty());
  for (const char* thin : {"1e-300", "1e-10"}) {
    check_one_doubt(with_part(replaced(box, "[0.02,", std::string("[") + thin + ",") + "position = [0.02, 0.02, 0.5]\n"),
                    {"part \"p\" is 1e-", "m thin", "is it in another unit?"});
  }
}

TEST_CASE("doubts: grains that leave the bounds before they land") {
  const std::string floor = "[[part]]\nname = \"p\"\nshape = \"plane\"\nposition = [0, 0, -10]\n";
  check_one_doubt(in_open(floor), {"7 of 7 grains start above nothing"});
  Scene deep = in_open(floor);
  std::get<Open>(deep.container).bounds = {{-20, -20, -20}, {40, 40, 40}};
  for (const std::string& doubt : doubts_about(deep)) CHECK(doubt.find("above nothing") == std::string::npos);
}

TEST_CASE("doubts: gravity of zero is none, and motions that start too late are named") {
  const std::string weightless = replaced(kSceneText, "acceleration = [0, 0, -9.81]", "acceleration = [0, 0, 0]");
  CHECK(doubts_about(scene_of(weightless)).empty());
  const std::string box = "shape = \"box\"\nsize = [0.02, 0.02, 0.02]\nposition = [0.02, 0.02, 0.5]\n";
  const std::string motion = "[[part.motion]]\nkind = \"velocity\"\nvelocity = [0, 0, -1]\n";
  check_one_doubt(with_part(box + motion + "until = 0.05\n" + motion + "from = 7\n"),
                  {"part \"p\" has motion[1].from = 7 s, and the run ends after 0.1 s: it never starts"});
  check_one_doubt(with_part(box + "[part.drive]\naxis = [0, 0, -1]\nforce = 0.1\nmass = 0.01\nfrom = 0.1\n"),
                  {"part \"p\" has drive.from = 0.1 s, and the run ends after 0.1 s"});
  check_one_doubt(with_part(box + "free = { mass = 1e-4, from = 0.2 }\n"), {"part \"p\" has free.from = 0.2 s"});
}

TEST_CASE("doubts: grains that sink by their own weight") {
  check_one_doubt(scene_of(replaced(kSceneText, "erp = 0.2", "erp = 0")), {"solver.erp is 0"});
  check_one_doubt(scene_of(replaced(replaced(kSceneText, "cfm = 1e-10", "cfm = 1"), "erp = 0.2", "erp = 0.01")),
                  {"grain \"die\" sinks by", "solver.cfm up to"});
  CHECK(doubts_about(scene_of(replaced(kSceneText, "cfm = 1e-10", "cfm = 0.001"))).empty());
}

TEST_CASE("doubts: a heavy grain on light ones is compared with the iterations, and each remedy would do") {
  const auto scene_with = [](double ratio, int iterations, double step) {
    Scene scene = scene_of(std::string(kSceneText));
    scene.kinds = {scene.kinds[0], scene.kinds[0]};
    scene.kinds[1].kind.name = "boulder";
    scene.kinds[1].kind.density *= ratio;
    scene.solver.iterations = iterations;
    scene.time = {200 * step, step, 20 * step};
    return scene;
  };
  CHECK(doubts_about(scene_with(125, 40, 5e-4)).empty());
  // f / (1 - f) with f = (2000 / 2001)^40 is 49.5: the correction of overlaps would need 0.24 m/s, and 0.05 m/s are allowed.
  check_one_doubt(scene_with(8000, 40, 5e-4),
                  {R"("boulder") has 8e+03 times the mass of the lightest ("pea"))", "solver.iterations = 40",
                   "it sinks into such grains until more than 4 bear it", "time.step up to", "grains.md"});
  // f / (1 - f) = 5.776 with f = (250 / 251)^40: 9.81 m/s^2 (0.5 ms)^2 / 0.2 of it are 71 um.
  check_one_doubt(scene_with(1000, 40, 5e-4),
                  {"has 1e+03 times", "it sinks into such grains by about 0.0236 of their smallest half-axis"});
  const double step = std::sqrt(0.01 * 3e-3 * 0.2 / 9.81 / 5.776);
  CHECK(doubts_about(scene_with(1000, 40, 0.99 * step)).empty());
  CHECK(doubts_about(scene_with(1000, 40, 1.01 * step)).size() == 1);
  const double allowed = 0.01 * 3e-3 * 0.2 / 9.81 / (5e-4 * 5e-4);
  const double iterations = std::log1p(1 / allowed) / std::log1p(1 / 250.0);
  CHECK(doubts_about(scene_with(1000, static_cast<int>(iterations) + 1, 5e-4)).empty());
  CHECK(doubts_about(scene_with(1000, static_cast<int>(iterations) - 1, 5e-4)).size() == 1);
  const double ratio = 4 / std::expm1(std::log1p(1 / allowed) / 40);
  CHECK(doubts_about(scene_with(0.99 * ratio, 40, 5e-4)).empty());
  CHECK(doubts_about(scene_with(1.01 * ratio, 40, 5e-4)).size() == 1);
  Scene weightless = scene_with(8000, 40, 5e-4);
  weightless.effects.clear();
  check_one_doubt(weightless, {"no section [gravity]"});
}

TEST_CASE("doubts: a part with a mass is compared with the grains that bear it, and each remedy would do") {
  const double pea = 4 * std::numbers::pi / 3 * std::pow(3e-3, 3) * 1200;    // kg
  const double allowed = 0.01 * 3e-3 * 0.2 / 9.81 / (5e-4 * 5e-4);           // f / (1 - f) with f = (q / (1 + q))^20
  const double largest_part = 1 / std::expm1(std::log1p(1 / allowed) / 20);  // q
  const auto lid = [](const std::string& shape, const std::string& law) {
    return with_part(shape + "position = [0.025, 0.03, 0.3]\n" + law);
  };
  const auto free_part = [&](const std::string& shape, double mass) {
    return lid(shape, "free = { mass = " + shortest(mass) + " }\n");
  };
  const std::string ball = "shape = \"ellipsoid\"\nhalf_axes = [0.01, 0.01, 0.01]\n";
  CHECK(doubts_about(free_part(ball, 0.999 * 4 * pea * largest_part)).empty());
  check_one_doubt(free_part(ball, 1.001 * 4 * pea * largest_part),
                  {"part \"p\" on grains has", "times the mass of the lightest (\"pea\")",
                   "with solver.iterations = 20 it sinks into such grains by about 0.01 of their smallest half-axis",
                   "or part.free.mass up to", "kg would do (grains.md)"});
  // Peas are spheres of 6 mm. A square of 15 mm covers 6.25 of them, and one of 40 mm all the 7 grains of the scene.
  const std::string small = "shape = \"box\"\nsize = [0.015, 0.015, 0.01]\n";
  CHECK(doubts_about(free_part(small, 0.999 * 6.25 * pea * largest_part)).empty());
  CHECK(doubts_about(free_part(small, 1.001 * 6.25 * pea * largest_part)).size() == 1);
  const std::string wide = "shape = \"box\"\nsize = [0.04, 0.04, 0.01]\n";
  CHECK(doubts_about(free_part(wide, 0.999 * 7 * pea * largest_part)).empty());
  CHECK(doubts_about(free_part(wide, 1.001 * 7 * pea * largest_part)).size() == 1);
  const std::vector<std::string> of_heavy = doubts_about(free_part(wide, 100));
  REQUIRE(of_heavy.size() == 2);
  check_says(of_heavy[0], {"until more than 7 bear it"});
  check_says(of_heavy[1], {"part \"p\" presses with 6.13e+05 Pa on about 1 layer of grains"});  // 981 N on 16 cm^2
  // A force adds to the weight: with three times the acceleration a third of f / (1 - f) is allowed.
  const double pressed = 7 * pea / std::expm1(std::log1p(3 / allowed) / 20);
  const auto drive = [&](double mass, double force) {
    return lid(wide, "drive = { axis = [0, 0, -1], mass = " + shortest(mass) + ", force = " + shortest(force) + " }\n");
  };
  CHECK(doubts_about(drive(0.999 * pressed, 2 * 9.81 * 0.999 * pressed)).empty());
  check_one_doubt(drive(1.001 * pressed, 2 * 9.81 * 1.001 * pressed), {"part \"p\" on grains", "or a smaller force on it"});
  CHECK(doubts_about(drive(1.001 * pressed, 0)).empty());
  CHECK(doubts_about(drive(100, -9.81 * 100)).empty());  // held by its drive
}

namespace {

/// A single layer of 5 x 5 weightless balls on a floor. A servo presses them with 1.23 kPa, in `steps` of 20 ms at most.
struct PressedLayer {
  double step = 0.02;  // s
  double gain = 2e-5;  // m/(s Pa)
  int iterations = 40;

  Scene scene() const {
    constexpr double kPitch = 0.0102;  // m
    Scene scene = scene_of(Box{{5 * kPitch, 5 * kPitch}}, {{ball(), 25}});
    scene.effects.erase(scene.effects.begin());  // gravity
    scene.start = StartState{.overlap = 0.1};
    for (int i = 0; i < 25; ++i) {
      scene.start->grains.push_back(
          {.position = {kPitch * (i % 5 + 0.5), kPitch * (i / 5 + 0.5), 5e-3}});  // NOLINT(*-integer-division)
    }
    scene.walls.push_back({"lid", BoxShape{{5 * kPitch, 5 * kPitch, 5e-3}}, {{2.5 * kPitch, 2.5 * kPitch, 0.01251}}});
    scene.walls.back().drive = Drive{-Vector3::UnitZ(), 0, 0};
    scene.walls.back().drive->servo = Servo{kStress, gain, 0.1, area()};
    scene.solver.iterations = iterations;
    scene.time = {600 * step, step, 600 * step};
    return scene;
  }
  double overlap() const {  // of a half-axis, at rest
    const Scene pressed = scene();
    Simulation simulation(pressed, 1);
    for (int i = 0; i < 600; ++i) simulation.stepper.step(false);
    return measure_overlap(simulation.world).relative_to_pair;
  }

  static constexpr double kStress = 1234;
  static double area() { return 0.051 * 0.051; }
};

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  REQUIRE(at != std::string::npos);
  return std::stod(text.substr(at + words.size()));
}

}  // namespace

TEST_CASE("doubts: a servo on a single layer is compared with the iterations, as a run overlaps, and each remedy would do") {
  const auto doubts_of = [](const PressedLayer& layer) {
    std::vector<std::string> doubts = doubts_about(layer.scene());
    // Its stress is near what the iterations carry, which has a doubt of its own.
    std::erase_if(doubts, [](const std::string& doubt) { return doubt.find("presses with") != std::string::npos; });
    return doubts;
  };
  const PressedLayer coarse;
  // The servo has the mass step x area / gain on 25 grains, and the speed gain x stress in each step.
  const double part = coarse.step * PressedLayer::area() / coarse.gain / 25 / mass_of(ball());     // q
  const double allowed = 0.01 * 5e-3 * 0.2 / (coarse.gain * PressedLayer::kStress * coarse.step);  // f / (1 - f)
  const double iterations = std::log1p(1 / allowed) / std::log1p(1 / part);
  CHECK(doubts_of({.iterations = static_cast<int>(iterations) + 1}).empty());
  CHECK(doubts_of({.iterations = static_cast<int>(iterations)}).size() == 1);

  const std::vector<std::string> doubts = doubts_of(coarse);
  REQUIRE(doubts.size() == 1);
  check_says(doubts.front(),
             {"part \"lid\" on grains, as a servo of the mass time.step x area / part.drive.gain, has",
              "it sinks into such grains by about 0.", "or part.drive.gain from", "m/(s Pa) on would do (grains.md)"});
  CHECK(coarse.overlap() > 0.1);
  constexpr double kRounding = 0.005;  // of three digits
  const double step = number_after(doubts.front(), "time.step up to ");
  const double gain = number_after(doubts.front(), "part.drive.gain from ");
  const auto fewest = static_cast<int>(number_after(doubts.front(), "solver.iterations from "));
  const std::vector<PressedLayer> remedies = {
      {.step = step * (1 - kRounding)}, {.gain = gain * (1 + kRounding)}, {.iterations = fewest}};
  for (const PressedLayer& remedy : remedies) {
    CHECK(doubts_of(remedy).empty());
    CHECK(remedy.overlap() < 0.01);
  }
  CHECK(doubts_of({.step = step * (1 + kRounding)}).size() == 1);
  CHECK(doubts_of({.gain = gain * (1 - kRounding)}).size() == 1);
}

TEST_CASE("doubts: of the kinds without grains, those that a feeder brings are compared in mass") {
  const auto fed = [](const std::string& mixture) {
    Scene scene =
        scene_of(replaced(kSceneText, "count = 2", "count = 0") +
                 "[[feeder]]\nname = \"f\"\ncorner = [0, 0, 0.1]\nsize = [0.05, 0.06, 0.05]\ngrains_per_second = 100\n" + mixture);
    scene.kinds[1].kind.density *= 600;
    return scene;
  };
  CHECK(doubts_about(fed("[[feeder.grain]]\nname = \"pea\"\nfraction = 1\n")).empty());
  const std::string half = "\"\nfraction = 0.5\n[[feeder.grain]]\nname = \"";
  check_one_doubt(fed("[[feeder.grain]]\nname = \"pea" + half + "die\"\nfraction = 0.5\n"), {"the heaviest grain (\"die\")"});
}

TEST_CASE("doubts: a measurement of a place that no grain reaches is named with the axis") {
  const auto measured = [](const std::string& rest) {
    return scene_of(std::string(kSceneText) + "[[measurement]]\nname = \"m\"\ninterval = 0.01\n" + rest);
  };
  const std::string stress = "kind = \"stress\"\n";
  CHECK(doubts_about(measured(stress + "lower = [0, 0, 0]\nupper = [0.05, 0.06, 0.1]\n")).empty());
  CHECK(doubts_about(measured(stress + "lower = [-1, 0, 0.2]\nupper = [0.001, 0.06, 9]\n")).empty());  // where grains may jump
  check_one_doubt(
      measured(stress + "lower = [0, 10, 0]\nupper = [0.05, 40, 0.1]\n"),
      {"measurement \"m\" has a box that no grain reaches", "10 and 40 m along y", "from 0 to 0.06 m", "another unit?"});
  check_one_doubt(measured(stress + "lower = [0, 0, 5]\nupper = [0.05, 0.06, 9]\n"), {"5 and 9 m along z"});
  const std::string passage = "kind = \"passage\"\naxis = \"z\"\n";
  CHECK(doubts_about(measured(passage + "at = 0.005\n")).empty());
  check_one_doubt(measured(passage + "at = 5\n"), {"a plane that no grain reaches: measurement.at is 5 m along z"});
  check_one_doubt(measured(passage + "at = -0.001\n"), {"measurement.at is -0.001 m along z"});
  // A box limits the plane across its axis alone.
  CHECK(doubts_about(measured(passage + "at = 0.005\nlower = [0, 0, 5]\nupper = [0.05, 0.06, 9]\n")).empty());
  check_one_doubt(measured(passage + "at = 0.005\nlower = [5, 0, 0]\nupper = [9, 1, 1]\n"), {"5 and 9 m along x"});
  check_one_doubt(measured("kind = \"mixing\"\naxis = \"x\"\nat = 25\nlower = [0, 0, 0]\nupper = [1, 1, 1]\ncells = [2, 2, 2]\n"),
                  {"measurement.at is 25 m along x"});
}

TEST_CASE("doubts: what a part presses with is compared with the iterations and the layers, and each remedy would do") {
  // p d^2 step^2 / m is 0.05 x 20 radii r, with d = 2 r and m = 4 pi / 3 r^3 1200 kg/m^3.
  const double most = 0.05 * 20 * 3e-3 * std::numbers::pi / 3 * 3e-3 * 1200 / (5e-4 * 5e-4);  // Pa, in one layer
  const auto lid = [](const std::string& drive) {
    return std::string("shape = \"box\"\nsize = [0.05, 0.06, 0.01]\nposition = [0.025, 0.03, 0.3]\ndrive = { axis = [0, 0, -1], ") +
           drive + " }\n";
  };
  const auto pressed = [&](double pressure, const std::vector<std::string>& overrides = {}, int peas = 5) {
    const std::string servo = lid("gain = 1e-6, largest_speed = 0.1, area = 0.003, stress = " + shortest(pressure));
    std::string text = replaced(kSceneText, "count = 5", "count = " + std::to_string(peas));
    std::vector<std::string> found;
    for (const std::string& doubt : doubts_about(scene_of(text.append("[[part]]\nname = \"p\"\n").append(servo), overrides))) {
      if (doubt.find("presses with") != std::string::npos) found.push_back(doubt);
    }
    return found;
  };
  CHECK(pressed(0.999 * most).empty());
  REQUIRE(pressed(4 * most).size() == 1);
  check_says(
      pressed(4 * most)[0],
      {"part \"p\" presses with", "on about 1 layer of grains: a free grain would move by 0.012 m in a step, 4 of the smallest",
       "solver.iterations = 20 hold 1", "time.step up to 0.00025 s", "solver.iterations from 80 on", "would do (parts.md)"});
  CHECK(pressed(3.99 * most, {"time.step=2.5e-4"}).empty());
  CHECK(pressed(3.99 * most, {"solver.iterations=80"}).empty());
  // No remedy is out of the range of its key.
  REQUIRE(pressed(2e4 * most).size() == 1);
  check_says(pressed(2e4 * most)[0], {"time.step up to 3.54e-06 s, or up to"});
  // A bed of peas and two dice of 3.5 layers bears a twelfth.
  const double die = mass_of(scene_of(std::string(kSceneText)).kinds[1].kind) / 1190;  // m^3
  const double layers = (400 * 4 * std::numbers::pi / 3 * 27e-9 + 2 * die) / (0.6 * 0.003 * 6e-3);
  REQUIRE(layers > 3);
  CHECK(pressed(0.999 * most / layers / layers, {}, 400).empty());
  CHECK(pressed(1.001 * most / layers / layers, {}, 400).size() == 1);
  // A force and the weight, over the area.
  const auto by_force = [&](double pressure) {
    Scene scene = with_part(lid("mass = 0.01, force = " + shortest(0.003 * pressure - 0.0981)));
    return std::ranges::count_if(doubts_about(scene), [](const std::string& doubt) { return doubt.find("presses with") < 99; });
  };
  CHECK(by_force(0.999 * most) == 0);
  CHECK(by_force(1.001 * most) == 1);
}

TEST_CASE("doubts: a grain may be anywhere above the container where something lifts it, and anywhere without gravity") {
  const std::string high =
      "[[measurement]]\nkind = \"grid\"\ninterval = 0.01\nlower = [0, 0, 5]\nupper = [1, 1, 9]\ncells = [1, 1, 1]\n";
  const std::string text = kSceneText;
  CHECK(doubts_about(scene_of(text + high)).size() == 1);
  CHECK(doubts_about(scene_of(replaced(text, "acceleration = [0, 0, -9.81]", "acceleration = [0, 0, 0]") + high)).empty());
  CHECK(doubts_about(scene_of(replaced(text, "acceleration = [0, 0, -9.81]", "acceleration = [1, 0, -9.81]") + high)).empty());
  CHECK(doubts_about(scene_of(text + "[buoyancy]\ndensity = 2000\nlevel = 8\n" + high)).empty());
  CHECK(doubts_about(scene_of(text +
                              "[[feeder]]\nname = \"f\"\ncorner = [0, 0, 0.1]\nsize = [0.05, 0.06, 0.05]\n"
                              "grains_per_second = 100\nvelocity = [0, 0, 5]\n" +
                              high))
            .empty());
  const std::string lift = "[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [0.01, 0.01, 0.01]\nposition = [0.02, 0.02, 0.5]\n";
  CHECK(doubts_about(scene_of(text + lift + "[[part.motion]]\nkind = \"velocity\"\nvelocity = [0, 0, 1]\n" + high)).empty());
}

TEST_CASE("doubts: anisotropic friction leaves no effect to friction, of the scene or of a part") {
  const std::string anisotropic = "[anisotropic_friction]\nalong = 0.1\nacross = 0.5\ndirection = [1, 0, 0]\n";
  const std::string alone = replaced(kSceneText, "[friction]\ncoefficient = 0.4\n", anisotropic);
  CHECK(doubts_about(scene_of(alone)).empty());
  const std::vector<const char*> says = {"anisotropic_friction replaces friction", "part.friction have no effect"};
  check_one_doubt(scene_of(kSceneText + anisotropic), says);
  check_one_doubt(scene_of(alone + "[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [0.01, 0.01, 0.01]\n"
                                   "position = [0.02, 0.02, 0.5]\nfriction = 0.5\n"),
                  says);
}

TEST_CASE("doubts: a resistance to rolling above the half-axes is probably a number without unit") {
  const auto with = [](const std::string& values) { return scene_of(std::string(kSceneText) + "[rolling_resistance]\n" + values); };
  CHECK(doubts_about(with("rolling = 6e-3\nspinning = 1e-3\nwalls = 0\n")).empty());  // a die has 6 mm
  check_one_doubt(with("rolling = 0.09\n"),
                  {"rolling_resistance.rolling is a length, 0.09 m, 15 times the largest half-axis (0.006 m)", "without unit"});
  check_one_doubt(with("rolling = 1e-4\nwalls = 0.1\n"), {"rolling_resistance.walls is a length"});
  check_one_doubt(with("rolling = 1e-4\nspinning = 0.1\nwalls = 1e-4\n"), {"rolling_resistance.spinning is a length"});
}

TEST_CASE("doubts: a servo that turns its back to all grains is named, with the axis that would do") {
  const auto servo = [](const std::string& position, const std::string& axis) {
    return with_part("shape = \"box\"\nsize = [0.04, 0.04, 0.01]\nposition = " + position + "\n[part.drive]\naxis = " + axis +
                     "\nstress = 1000\ngain = 1e-4\nlargest_speed = 1\n");
  };
  CHECK(doubts_about(servo("[0.025, 0.03, 1]", "[0, 0, -1]")).empty());
  check_one_doubt(servo("[0.025, 0.03, 1]", "[0, 0, 2]"),
                  {"part \"p\" is a servo whose axis points away from all grains", "part.drive.axis = [0, 0, -1] would do"});
  CHECK(doubts_about(servo("[0.025, 0.03, 0.005]", "[0, 0, 1]")).empty());
  const std::string plane =
      "shape = \"plane\"\nposition = [0, 0, 1]\naxis = [1, 0, 0]\nangle = 180\n[part.drive]\nstress = 100\ngain = 1e-4\n"
      "largest_speed = 1\narea = 0.003\naxis = ";
  CHECK(doubts_about(with_part(plane + "[0, 0, -1]\n")).empty());
  check_one_doubt(with_part(plane + "[0, 0, 1]\n"), {"points away from all grains"});
}

namespace {

/// Two grains of a kind that meet without weight, on springs of this stiffness (N/m).
Scene on_springs(const GrainKind& kind, double stiffness) {
  Scene scene = scene_of(Box{{0.1, 0.1}}, {{kind, 2}});
  scene.effects = {supernormal::effects::Compliance{stiffness, 0, {}}};
  scene.time.duration = 0.02;
  const double x = 0.05, y = kind.bounding_radius();
  scene.start = StartState{.has_velocities = true,
                           .overlap = 0.1,
                           .grains = {{.position = {x, x, 0.05}, .velocity = {0.1, 0, 0}},
                                      {.position = {x + 2 * y + 1e-6, x, 0.05}, .velocity = {-0.1, 0, 0}}}};
  return scene;
}

}  // namespace

TEST_CASE("doubts: a servo that acts across its plane is named, with the normal of the plane") {
  const auto servo = [](const std::string& axis) {
    return in_cell("x_low.drive = { stress = 100, gain = 1e-4, largest_speed = 0.2" + axis + " }\n");
  };
  CHECK(doubts_about(servo("")).empty());
  CHECK(doubts_about(servo(", axis = [1, 0.001, 0]")).empty());
  for (const char* axis : {"[0, 1, 0]", "[1, 1, 0]"}) {
    check_one_doubt(servo(std::string(", axis = ") + axis), {"wall \"x_low\" is a servo whose axis is not the normal of its plane",
                                                             "container.x_low.drive.stress is the force along the axis",
                                                             "container.x_low.drive.axis = [1, 0, 0] would do"});
  }
}

TEST_CASE("doubts: six servos of a cell have one sentence, of the side that is worst, with the names of all") {
  const auto check_sides = [](const Scene& scene, const std::vector<const char*>& says) {
    const std::vector<std::string> doubts = doubts_about(scene);
    REQUIRE_FALSE(doubts.empty());
    check_says(doubts.back(), says);
    for (const std::string& doubt : doubts) {
      check_says(doubt,
                 {"; the same holds for \"", "\"x_low\"", "\"x_high\"", "\"y_low\"", "\"y_high\"", "\"z_low\"", "\"z_high\""});
    }
  };
  const std::string servo = ".drive = { stress = 1e5, gain = 5e-4, largest_speed = 0.2 }\n";
  check_sides(in_cell(on_all_sides(servo)), {"wall \"x_low\" presses with 1e+05 Pa"});
  std::string springs = replaced(kSceneText, "[max_correcting_velocity]\nvelocity = 0.05\n", "[compliance]\nstiffness = 10\n");
  springs = replaced(springs, "kind = \"box\"\nwidth = [0.05, 0.06]\n",
                     "kind = \"cell\"\nwidth = [0.05, 0.06]\nheight = 0.07\n" +
                         on_all_sides(".drive = { stress = 1, gain = 0.03, largest_speed = 0.2 }\n"));
  check_sides(scene_of(springs, {"container.y_high.drive.gain=0.04"}),
              {"wall \"y_high\" is a servo with a gain of 0.04", "container.y_high.drive.gain up to 0.0288 m/(s Pa)"});
  check_sides(in_cell(on_all_sides(".drive = { stress = 100, gain = 1, largest_speed = 20 }\n")),
              {"is driven 0.01 m in a step", "container.x_low.drive.largest_speed up to 6 m/s"});
  check_sides(in_cell(on_all_sides(".drive = { stress = 1, gain = 1e-4, largest_speed = 0.2, from = 0.1 }\n")),
              {"wall \"x_low\" has drive.from = 0.1 s"});
}

TEST_CASE("doubts: a part that presses springs far together is named, and each remedy would do") {
  const double pea = 6e-3, deep = 0.1 * 3e-3;  // m: its diameter, and the depth
  const auto pressed = [](const std::string& springs, double stress) {
    const std::string text = replaced(kSceneText, "[max_correcting_velocity]\nvelocity = 0.05\n", springs);
    return scene_of(text + "[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [0.05, 0.06, 0.01]\nposition = [0.025, 0.03, 0.3]\n" +
                    "drive = { axis = [0, 0, -1], gain = 1e-9, largest_speed = 0.1, area = 0.003, stress = " + shortest(stress) +
                    " }\n");
  };
  const std::string linear = "[compliance]\nstiffness = 20\n";
  const double most = 20 * deep / pea / pea;
  CHECK(doubts_about(pressed(linear, 0.999 * most)).empty());
  check_one_doubt(pressed(linear, 4 * most),
                  {"part \"p\" presses with 667 Pa: the springs of a contact overlap by about 0.4 of the smallest half-axis",
                   "compliance.stiffness from 80 N/m on, or up to 167 Pa would do (parts.md)"});
  const std::string hertz = "[hertz]\nyoungs_modulus = 1e4\npoisson_ratio = 0.3\n";
  const double force = 4.0 / 3 * 1e4 / (2 * (1 - 0.09)) * std::sqrt(3e-3 / 2) * std::pow(deep, 1.5);
  CHECK(doubts_about(pressed(hertz, 0.999 * force / pea / pea)).empty());
  check_one_doubt(pressed(hertz, 8 * force / pea / pea),
                  {"overlap by about 0.4 of the smallest half-axis", "hertz.youngs_modulus from 8e+04 Pa on"});
}

TEST_CASE("doubts: walls that fall for ever are named: free ones above nothing, driven ones above no grain") {
  const std::string floor = "[[part]]\nname = \"floor\"\nshape = \"box\"\nsize = [1, 1, 0.1]\nposition = [0, 0, -0.05]\n";
  const auto plate = [&](const std::string& position, const std::string& law) {
    return in_open(floor + "[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [0.02, 0.02, 0.01]\nposition = " + position + '\n' +
                   law);
  };
  const std::string free = "free = { mass = 1e-4 }\n";
  CHECK(doubts_about(plate("[0.025, 0.03, 1]", free)).empty());
  CHECK(doubts_about(plate("[0.509, 0, 1]", free)).empty());  // it may land on the rim
  check_one_doubt(plate("[0.511, 0, 1]", free), {"part \"p\" is free above nothing: no wall is below it, and it falls for ever"});
  check_one_doubt(plate("[0, 0, -1]", free), {"is free above nothing"});
  CHECK(doubts_about(plate("[0.511, 0, 1]", "free = { mass = 1e-4, velocity = [-1, 0, 0] }\n")).empty());
  CHECK(doubts_about(in_cell("[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [0.02, 0.02, 0.01]\nposition = [9, 9, 9]\n" + free))
            .empty());

  const auto driven = [&](const std::string& position, const std::string& rest) {
    return plate(position, "drive = { axis = [0, 0, -1], mass = 1e-3" + rest + " }\n");
  };
  CHECK(doubts_about(driven("[0.025, 0.03, 1]", ", force = 1e-3")).empty());
  check_one_doubt(driven("[0.025, 0.03, -1]", ", force = 1e-3"),
                  {"part \"p\" falls for ever: no grain is below it", "part.drive.travel would do"});
  CHECK(doubts_about(driven("[0.025, 0.03, -1]", ", force = 1e-3, travel = [0, 1]")).empty());
  CHECK(doubts_about(driven("[0.025, 0.03, -1]", ", force = -0.01")).empty());  // 1 g weighs less
  check_one_doubt(in_cell("z_low.drive = { force = 0.5, mass = 0.1 }\n"), {"wall \"z_low\" falls for ever"});
  CHECK(doubts_about(in_cell("z_low.drive = { force = 1, mass = 0.1 }\n")).empty());
}

TEST_CASE("doubts: sides of a cell that meet by their motions are named with the time, and refused between a servo") {
  const auto moved = [](const std::string& rest) {
    return in_cell("x_low.motion = [{ kind = \"velocity\", velocity = [1, 0, 0]" + rest + " }]\n");
  };
  check_one_doubt(moved(""), {R"(walls "x_low" and "x_high" meet after 0.05 s by their motions)"});
  CHECK(doubts_about(moved(", until = 0.04")).empty());
  const auto refusal = [&](const std::string& keys) {
    try {
      refuse_overlapping_start(in_cell(keys));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string servo = "z_high.drive = { stress = 100, gain = 1e-4, largest_speed = 0.2";
  const std::string motion = "x_low.motion = [{ kind = \"velocity\", velocity = [1, 0, 0] }]\n";
  check_says(refusal(motion + servo + " }\n"),
             {R"(the servo of wall "z_high" acts between "x_low" and "x_high")", "after 0.05 s", "container.z_high.drive.area"});
  CHECK(refusal(motion + servo + ", area = 0.003 }\n").empty());
  const std::string turn = "x_low.motion = [{ kind = \"rotation\", axis = [0, 0, 1], point = [0, 0, 0], rpm = 6 }]\n";
  check_says(refusal(turn + servo + " }\n"), {"do not face each other", "after 0.0005 s"});
  CHECK(doubts_about(in_cell(turn)).empty());
}

TEST_CASE("doubts: springs with contacts of fewer than ten steps are named, as a run counts them") {
  const double step = 5e-4;
  const double tenth = std::numbers::pi / 10 / step;  // rad/s
  const double stiffness = tenth * tenth * mass_of(ball()) / 2;
  for (const bool is_coarse : {true, false}) {
    CAPTURE(is_coarse);
    const Scene scene = on_springs(ball(), (is_coarse ? 1.001 : 0.999) * stiffness);
    Simulation simulation(scene, 1);
    for (int i = 0; i < scene.time.steps(); ++i) simulation.stepper.step(false);
    const auto costs = simulation.effect_costs();
    const auto cost = std::ranges::find_if(costs, [](const auto& of) { return std::string(of.name) == "compliance"; });
    REQUIRE(cost != costs.end());
    CHECK(cost->contacts >= 9);
    CHECK((cost->coarse > 0) == is_coarse);
    CHECK(doubts_about(scene).size() == (is_coarse ? 1 : 0));
  }
  check_one_doubt(on_springs(ball(), 4 * stiffness),
                  {"compliance has contacts of fewer than ten steps: a shorter step would be better", R"("ball" and "ball")",
                   "may touch for 5 steps", "time.step up to 0.00025 s would do; compliance.stiffness up to",
                   "N/m would do too, but softer springs overlap 4 times as deep under the same load, and by"});
}

TEST_CASE("doubts: softer springs overlap as deep as they are said to") {
  const double stiffness = 16 * std::pow(std::numbers::pi / 10 / 5e-4, 2) * mass_of(ball()) / 2;  // 2.5 steps
  const std::vector<std::string> doubts = doubts_about(on_springs(ball(), stiffness));
  REQUIRE(doubts.size() == 1);
  check_says(doubts.front(), {"softer springs overlap 16 times as deep under the same load", "in an impact with 0.1 m/s"});
  // m: the depth is speed / sqrt(stiffness (1 / m1 + 1 / m2)), of the fastest grain against one at rest.
  const double depth = 0.1 * std::sqrt(mass_of(ball()) / 2 / stiffness);
  CHECK(number_after(doubts.front(), "the same load, and by ") == relative(4 * depth / 5e-3).epsilon(0.005));
  CHECK(number_after(doubts.front(), " and not ") == relative(depth / 5e-3).epsilon(0.005));
  Scene resting = on_springs(ball(), stiffness);
  for (StartGrain& grain : resting.start->grains) grain.velocity = {};
  const std::vector<std::string> of_rest = doubts_about(resting);
  REQUIRE(of_rest.size() == 1);
  CHECK(of_rest.front().ends_with("times as deep under the same load"));
}

TEST_CASE("doubts: a light part on springs is named with the grain that it meets") {
  Scene scene = on_springs(ball(), std::pow(std::numbers::pi / 10 / 5e-4, 2) * mass_of(ball()) / 4);
  CHECK(doubts_about(scene).empty());
  scene.walls.push_back({"lid", BoxShape{{0.01, 0.01, 0.01}}, {{0.05, 0.05, 0.2}}});
  scene.walls.back().drive = Drive{-Vector3::UnitZ(), 0, 1.01 * mass_of(ball()) / 3};
  CHECK(doubts_about(scene).empty());
  scene.walls.back().drive->mass = 0.99 * mass_of(ball()) / 3;
  check_one_doubt(scene, {R"("ball" and part "lid" may touch for 9.)"});
}

TEST_CASE("doubts: a grain that is hit off its centre turns away, and touches for fewer steps") {
  // The lever of a normal of a spheroid with half-axes a and b is a - b at most, and its moment m (a^2 + b^2) / 5.
  const auto& [a, same, b] = lentil().half_axes;
  const double mobility = (1 + 5 * (a - b) * (a - b) / (a * a + b * b)) / mass_of(lentil());
  const double stiffness = std::pow(std::numbers::pi / 10 / 5e-4, 2) / (2 * mobility);
  CHECK(doubts_about(on_springs(lentil(), stiffness)).empty());
  CHECK(doubts_about(on_springs(lentil(), 1.02 * stiffness)).size() == 1);
}

TEST_CASE("doubts: Hertz's contacts of the fall from the start are named if they last fewer than ten steps") {
  const auto with = [](double modulus) {
    Scene scene = scene_of(Box{{0.1, 0.1}}, {{ball(), 8}});
    scene.effects = {supernormal::effects::Gravity{{0, 0, -9.81}}, supernormal::effects::Hertz{modulus, 0.3, 1, {}}};
    return scene;
  };
  const double speed = fall_from_start(with(1e6))->speed;
  const double mass = mass_of(ball()) / 2, radius = 5e-3 / 2;
  // s, half a period at the depth of (15 m v^2 / (16 E* sqrt(R)))^0.4.
  const auto half_period = [&](double effective) {
    const double depth = std::pow(15 * mass * speed * speed / (16 * effective * std::sqrt(radius)), 0.4);
    return std::numbers::pi * std::sqrt(mass / (2 * effective * std::sqrt(radius * depth)));
  };
  const double modulus = std::pow(half_period(1) / (10 * 5e-4), 2.5);  // E*, since the half-period is as E*^-0.4
  CHECK(half_period(modulus) == relative(10 * 5e-4).epsilon(1e-9));
  const double youngs = 2 * modulus * (1 - 0.3 * 0.3);
  CHECK(doubts_about(with(0.99 * youngs)).empty());
  check_one_doubt(with(1.01 * youngs), {"hertz has contacts of fewer than ten steps", "hertz.youngs_modulus up to",
                                        "Pa would do too, but softer springs overlap 1.0"});
  const std::vector<std::string> doubts = doubts_about(with(32 * youngs));  // 32^0.4 = 4 times fewer steps
  REQUIRE(doubts.size() == 1);
  CHECK(number_after(doubts.front(), "softer springs overlap ") == relative(std::pow(32, 2.0 / 3)).epsilon(0.005));
  CHECK(number_after(doubts.front(), "the same load, and by ") ==
        relative(4 * number_after(doubts.front(), " and not ")).epsilon(0.01));
}
