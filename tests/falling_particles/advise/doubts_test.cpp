// Tests of what a scene is refused for or asked about before it runs.
#include "advise/doubts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "advise/refusals.hpp"
#include "common/interval.hpp"
#include "model/grain_shape.hpp"
#include "observe/simulation.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/placement.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

Scene box_with(const std::string& part) { return scene_of(std::string(kSceneText) + "[[part]]\nname = \"p\"\n" + part); }

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

bool says_one_of(const Scene& scene, const std::string& words) {
  return std::ranges::any_of(doubts_about(scene), [&](const std::string& doubt) { return doubt.find(words) != std::string::npos; });
}

std::string refused_for(const Scene& scene) {
  return refusal_by([&] { refuse_bad_start(scene); });
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
  CHECK(refused_for(scene_of(std::string(kSceneText))).empty());
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
  Scene scene = scene_of(std::string(kSceneText), {"gravity.enabled=false"});
  check_one_doubt(scene, {"the scene has no section [gravity]"});
  scene.feeders.emplace_back();
  for (const std::string& doubt : doubts_about(scene)) CHECK(doubt.find("[gravity]") == std::string::npos);
  CHECK(doubts_about(scene_of(std::string(kSceneText), {"gravity.acceleration=[0, 0, 0]"})).empty());
}

TEST_CASE("doubts: a container a thousand grains wide was typed in millimetres") {
  const std::string in_metres = "width = [0.05, 0.06]", in_millimetres = "width = [50, 60]";
  CHECK_FALSE(says_one_of(scene_of(replaced(kSceneText, in_metres, "width = [5, 6]")), "lengths are in m"));
  const Scene scene = scene_of(replaced(kSceneText, in_metres, in_millimetres));
  CHECK(says_one_of(scene, "50 m wide"));
  CHECK(says_one_of(scene, "lengths are in m"));
}

TEST_CASE("doubts: overlaps that are never corrected, and feeders that throw too fast") {
  check_one_doubt(scene_of(std::string(kSceneText), {"solver.erp=0"}), {"solver.erp is 0"});
  const std::string feeder = "[[feeder]]\nname = \"f\"\ncorner = [0, 0, 0.1]\nsize = [0.05, 0.06, 0.05]\ngrains_per_second = 100\n";
  CHECK(doubts_about(scene_of(kSceneText + feeder)).empty());
  check_one_doubt(scene_of(kSceneText + feeder + "velocity = [0, 0, -500]\n"), {"grains of feeder \"f\" move 0.25 m"});
}

TEST_CASE("doubts: grains fall out of a hopper to its tray") {
  const auto with = [](double clearance) {
    return scene_of(Hopper{.outlet = 0.04,
                           .wall_angle = 30,
                           .diameter = 0.08,
                           .cylinder_height = 0.1,
                           .segments = 12,
                           .clearance = clearance,
                           .tray_width = 0.2,
                           .opens_at = 0.1},
                    {{ball(), 1}});
  };
  const double low = fall_from_start(with(0.1))->height;
  CHECK(low > 0.1);
  CHECK(fall_from_start(with(2))->height == relative(low + 1.9).epsilon(1e-12));
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
  check_one_doubt(box_with(paddle + "kind = \"velocity\"\nvelocity = [1000, 0, 0]\n"), {"part \"p\" moves 0.5 m in a step"});
  CHECK(doubts_about(box_with(paddle + "kind = \"velocity\"\nvelocity = [5, 0, 0]\n")).empty());
  check_one_doubt(box_with(paddle + "kind = \"vibration\"\ndirection = [1, 0, 0]\namplitude = 0.01\nfrequency = 200\n"),
                  {"part \"p\" moves"});
  check_one_doubt(box_with(paddle + "kind = \"rotation\"\naxis = [0, 1, 0]\npoint = [0, 0, 0]\nrpm = 300\n"), {"part \"p\" moves"});
  // A shaft turns in its own place, however fast, and a turntable in its own plane.
  const std::string spin = "[[part.motion]]\nkind = \"rotation\"\naxis = [0, 0, 1]\npoint = [1, 0, 1]\nrpm = 3000\n";
  CHECK(doubts_about(box_with("shape = \"cylinder\"\nradius = 0.02\nlength = 0.1\nposition = [1, 0, 1]\n" + spin)).empty());
  CHECK(doubts_about(box_with("shape = \"plane\"\nposition = [0, 0, -1]\n" + spin)).empty());
}

TEST_CASE("doubts: a servo that moves by more than a half-axis in a step is named, and one that springs do not hold") {
  const std::string box = "shape = \"box\"\nsize = [0.04, 0.04, 0.01]\nposition = [0.025, 0.03, 1]\n[part.drive]\n";
  const std::string servo = box + "axis = [0, 0, -1]\nstress = 1000\ngain = 1\nlargest_speed = ";
  check_one_doubt(box_with(servo + "10\n"), {"part \"p\" is driven 0.005 m in a step", "part.drive.largest_speed up to 6 m/s"});
  CHECK(doubts_about(box_with(servo + "1\n")).empty());
  // On springs the gain has a limit: 4 x (0.006 m)^2 / (10 N/m x 5e-4 s).
  const auto on_springs = [&](const char* gain, const char* springs = "[compliance]\nstiffness = 10\n") {
    const std::string text = replaced(kSceneText, "[max_correcting_velocity]\nvelocity = 0.05\n", springs);
    return scene_of(text + "[[part]]\nname = \"p\"\n" + replaced(servo, "gain = 1\n", gain) + "1\n");
  };
  check_one_doubt(on_springs("gain = 0.03\n"),
                  {"part \"p\" is a servo with a gain of 0.03 m/(s Pa)", "part.drive.gain up to 0.0288 m/(s Pa)"});
  CHECK(doubts_about(on_springs("gain = 0.028\n")).empty());
  // Hertz's spring under 1000 Pa: (6 x (5e6 Pa)^2 x 0.003 m x 0.036 N)^(1/3) = 2530 N/m.
  const char* const hertz = "[hertz]\nyoungs_modulus = 1e7\npoisson_ratio = 0\n";
  CHECK(says_one_of(on_springs("gain = 0.000115\n", hertz), "part.drive.gain up to 0.000114 m/(s Pa)"));
  CHECK_FALSE(says_one_of(on_springs("gain = 0.000113\n", hertz), "part.drive.gain up to"));
}

TEST_CASE("doubts: a grain may not start inside a part") {
  for (const std::string shape : {"shape = \"box\"\nsize = [0.1, 0.1, 0.1]\n", "shape = \"plane\"\nposition = [0, 0, 0.05]\n"}) {
    check_says(refused_for(box_with(shape)),
               {"starts at [", "deep in part \"p\"; allowed: walls that leave the start of the grains free"});
  }
  CHECK(refused_for(box_with("shape = \"plane\"\nposition = [0, 0, 0.009]\n")).empty());
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

TEST_CASE("doubts: grains of a start or a feeder above nothing are counted, with what their width may catch") {
  // Grains start from x = 0 to 50 mm. The plate ends within, and a grate has bars nearer to each other than a pea is wide.
  const auto plate = [](double end) {
    return "[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [1, 1, 0.1]\nposition = [" + shortest(end - 0.5) + ", 0, -0.05]\n";
  };
  const Scene scene = in_open(plate(1));
  CHECK(doubts_about(scene).empty());
  Random random(scene.seed);
  std::vector<double> ends;  // m, of the grains against x
  for (const Placement& at : place(scene, random)) {
    ends.push_back(at.position[0] - scene.kinds[at.kind].kind.bounding_radius());
  }
  for (const double end : {0.01, 0.02, 0.03}) {
    CAPTURE(end);
    const std::vector<std::string> doubts = doubts_about(in_open(plate(end)));
    CHECK((doubts.empty() ? 0 : std::stod(doubts.front())) == std::ranges::count_if(ends, [&](double from) { return from > end; }));
  }
  check_one_doubt(in_open(plate(0.02)), {" of 7 grains start above nothing", " out of it unless other grains are in the way"});
  check_one_doubt(in_open(plate(-1)), {"7 of 7 grains start above nothing"});
  std::string grate;
  for (int i = 0; i < 16; ++i) {
    grate += "[[part]]\nname = \"bar" + std::to_string(i) + "\"\nshape = \"box\"\nsize = [0.0015, 1, 0.01]\nposition = [" +
             shortest(0.0045 * i - 0.005) + ", 0, -0.02]\n";
  }
  CHECK(doubts_about(in_open(grate)).empty());
  const auto fed = [&](const char* corner, const std::string& more = "") {
    return in_open("[[feeder]]\nname = \"f\"\ncorner = " + std::string(corner) +
                   "\nsize = [0.1, 0.06, 0.05]\ngrains_per_second = 100\n" + more + plate(0.07));
  };
  check_one_doubt(fed("[0, 0, 0.6]"), {"some grains that feeder \"f\" brings are above nothing"});
  check_one_doubt(fed("[0, 0, -1]"), {"grains that feeder \"f\" brings are above nothing"});
  CHECK(doubts_about(fed("[0.6, 0, 0.2]", "velocity = [-1, 0, 0]\n")).empty());
  CHECK(doubts_about(fed("[0, 0, -1]", "[[sink]]\nname = \"s\"\npoint = [0, 0, -2]\nnormal = [0, 0, 1]\n")).empty());
}

TEST_CASE("doubts: grains that leave the bounds before they land") {
  const std::string floor = "[[part]]\nname = \"p\"\nshape = \"plane\"\nposition = [0, 0, -10]\n";
  check_one_doubt(in_open(floor), {"7 of 7 grains start above nothing"});
  Scene deep = in_open(floor);
  std::get<Open>(deep.container).bounds = {{-20, -20, -20}, {40, 40, 40}};
  for (const std::string& doubt : doubts_about(deep)) CHECK(doubt.find("above nothing") == std::string::npos);
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
                   "it sinks into such grains until more than four bear it", "time.step up to 0.000103 s", "grains.md"});
  // f / (1 - f) = 5.776 with f = (250 / 251)^40: 9.81 m/s^2 (0.5 ms)^2 / 0.2 of it are 71 um. Each bound is in the message.
  const double allowed = 0.01 * 3e-3 * 0.2 / 9.81 / (5e-4 * 5e-4);
  const double step = std::sqrt(allowed / 5.776) * 5e-4;
  const int iterations = static_cast<int>(std::log1p(1 / allowed) / std::log1p(1 / 250.0));
  const double ratio = 4 / std::expm1(std::log1p(1 / allowed) / 40);
  const std::string says_step = "time.step up to " + rounded(step) + " s, solver.iterations from " +
                                std::to_string(iterations + 1) + " on, or densities with masses up to 1 : " + rounded(ratio);
  check_one_doubt(scene_with(1000, 40, 5e-4),
                  {"has 1e+03 times", "it sinks into such grains by about 0.0236 of their smallest half-axis", says_step.c_str()});
  CHECK(doubts_about(scene_with(1000, 40, 0.99 * step)).empty());
  CHECK(doubts_about(scene_with(1000, iterations + 1, 5e-4)).empty());
  CHECK(doubts_about(scene_with(0.99 * ratio, 40, 5e-4)).empty());
  CHECK(doubts_about(scene_with(1.01 * ratio, 40, 5e-4)).size() == 1);
  Scene weightless = scene_with(8000, 40, 5e-4);
  weightless.effects.clear();
  check_one_doubt(weightless, {"no section [gravity]"});
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

TEST_CASE("doubts: what a part presses with is compared with the iterations and the layers, and each remedy would do") {
  // p d^2 step^2 / m is 0.05 x 20 radii r, with d = 2 r and m = 4 pi / 3 r^3 1200 kg/m^3.
  const double most = 0.05 * 20 * 3e-3 * std::numbers::pi / 3 * 3e-3 * 1200 / (5e-4 * 5e-4);  // Pa, in one layer
  const std::string lid = "shape = \"box\"\nsize = [0.05, 0.06, 0.01]\nposition = [0.025, 0.03, 0.3]\n";
  const auto pressed = [&](double pressure, const std::vector<std::string>& overrides = {}) {
    const std::string drive = "drive = { axis = [0, 0, -1], gain = 1e-6, largest_speed = 0.1, area = 0.003, stress = ";
    return scene_of(std::string(kSceneText) + "[[part]]\nname = \"p\"\n" + lid + drive + shortest(pressure) + " }\n", overrides);
  };
  CHECK(doubts_about(pressed(0.999 * most)).empty());
  check_one_doubt(pressed(4 * most),
                  {"part \"p\" presses with", "on about 1 layer of grains: a free grain would move by 0.012 m in a step, 4 of the",
                   "solver.iterations = 20 hold 1", "time.step up to 0.00025 s", "solver.iterations from 80 on", "(parts.md)"});
  CHECK(doubts_about(pressed(3.99 * most, {"time.step=2.5e-4"})).empty());
  CHECK(doubts_about(pressed(3.99 * most, {"solver.iterations=80"})).empty());
  // No remedy is out of the range of its key.
  check_one_doubt(pressed(2e4 * most), {"time.step up to 3.54e-06 s, or up to"});
  // A bed of peas and two dice of 3.5 layers bears a twelfth.
  const double die = mass_of(scene_of(std::string(kSceneText)).kinds[1].kind) / 1190;  // m^3
  const double layers = (400 * 4 * std::numbers::pi / 3 * 27e-9 + 2 * die) / (0.6 * 0.003 * 6e-3);
  REQUIRE(layers > 3);
  const std::vector<std::string> bed = {"grain[pea].count=400"};
  CHECK_FALSE(says_one_of(pressed(0.999 * most / layers / layers, bed), "presses with"));
  CHECK(says_one_of(pressed(1.001 * most / layers / layers, bed), "presses with"));
  // A force and the weight, over the area; of a free part its weight.
  const auto by_force = [&](double pressure) {
    return box_with(lid + "drive = { axis = [0, 0, -1], mass = 0.01, force = " + shortest(0.003 * pressure - 0.0981) + " }\n");
  };
  CHECK_FALSE(says_one_of(by_force(0.999 * most), "presses with"));
  CHECK(says_one_of(by_force(1.001 * most), "presses with"));
  check_one_doubt(box_with(lid + "free = { mass = 100 }\n"), {"presses with 3.27e+05 Pa on about 1 layer"});  // 981 N on 30 cm^2
  CHECK(doubts_about(box_with(lid + "free = { mass = 1 }\n")).empty());
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

TEST_CASE("doubts: six servos of a cell have one sentence, of the side that is worst, with the names of all") {
  std::string keys;
  for (const char* side : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"}) {
    keys.append(side).append(".drive = { stress = 100, gain = 1, largest_speed = 20 }\n");
  }
  check_one_doubt(in_cell(keys, {"container.y_high.drive.largest_speed=30"}),
                  {"wall \"y_high\" is driven 0.015 m in a step", "container.y_high.drive.largest_speed up to 6 m/s",
                   R"(; the same holds for "x_low", "x_high", "y_low", "z_low", "z_high")"});
}

TEST_CASE("doubts: sides of a cell between which a servo acts may not meet by their motions") {
  const std::string servo = "z_high.drive = { stress = 100, gain = 1e-4, largest_speed = 0.2";
  const std::string motion = "x_low.motion = [{ kind = \"velocity\", velocity = [1, 0, 0] }]\n";
  check_says(refused_for(in_cell(motion + servo + " }\n")),
             {R"(the servo of wall "z_high" acts between "x_low" and "x_high")", "after 0.05 s", "container.z_high.drive.area"});
  CHECK(refused_for(in_cell(motion + servo + ", area = 0.003 }\n")).empty());
  const std::string turn = "x_low.motion = [{ kind = \"rotation\", axis = [0, 0, 1], point = [0, 0, 0], rpm = 6 }]\n";
  check_says(refused_for(in_cell(turn + servo + " }\n")), {"do not face each other", "after 0.0005 s"});
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
  check_one_doubt(on_springs(ball(), 4 * stiffness), {"may touch for 5 steps", "time.step up to 0.00025 s"});
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
  const double youngs = 2 * modulus * (1 - 0.3 * 0.3);
  CHECK(doubts_about(with(0.99 * youngs)).empty());
  check_one_doubt(with(32 * youngs), {"contacts of fewer than ten steps", "may touch for 2.5 steps"});  // 32^0.4 = 4
  check_one_doubt(with(1.01 * youngs), {"contacts of fewer than ten steps"});
}
