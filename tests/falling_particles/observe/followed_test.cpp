// Measurements that follow a run from step to step, against closed forms.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/read_file.hpp"
#include "measured.hpp"
#include "model/grain_shape.hpp"
#include "observe/measuring.hpp"
#include "observe/simulation.hpp"
#include "output/picture.hpp"
#include "read_array.hpp"
#include "run/checkpoints.hpp"
#include "run/stepwise_run.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

constexpr double kGravity = 9.81;
constexpr double kPeaRadius = 3e-3;
constexpr double kNoFriction = 1e-7;  // what a scene may have

/// Grains of kCatalogueText without walls of a container. The parts and measurements follow.
std::string open_scene(const std::string& more, double duration, double gravity = kGravity, double friction = 0.3) {
  std::string text =
      replaced(kSceneText, "kind = \"box\"\nwidth = [0.05, 0.06]",
               "kind = \"none\"\nstart = { corner = [0, 0, 0], size = [0.1, 0.1, 0.3] }\nbounds = { corner = [-9, -9, "
               "-9], size = [20, 20, 20] }");
  text = replaced(text, "duration = 0.1", "duration = " + shortest(duration));
  text = replaced(text, "iterations = 20", "iterations = 60");
  text = replaced(text, "[0, 0, -9.81]", "[0, 0, " + shortest(-gravity) + "]");
  return replaced(text, "coefficient = 0.4", "coefficient = " + shortest(friction)) + more;
}

Scene with_grains(const std::string& text, std::vector<StartGrain> grains) {
  Scene scene = scene_of(text);
  for (GrainCount& entry : scene.kinds) entry.count = 0;
  for (const StartGrain& grain : grains) ++scene.kinds[grain.kind].count;
  scene.start = StartState{.has_velocities = true, .overlap = 0.1, .grains = std::move(grains)};
  return scene;
}

StartGrain moving(std::size_t kind, const Point& position, const Point& velocity) {
  return {.kind = kind, .position = position, .velocity = velocity};
}

/// Runs a scene with its measurements. If `interrupted`, the run saves itself in the middle, and another one resumes it.
MeasuredTable run(const Scene& scene, const std::string& name, bool interrupted = false) {
  const TemporaryFolder parent;
  const OutputFolder folder(parent.path(), "run", result_names());
  std::optional<Simulation> simulation(std::in_place, scene, 1);
  std::optional<Measuring> measuring(std::in_place, scene, *simulation, folder);
  measuring->after_step(0, 0, true);
  const int end = scene.time.steps();
  for (int step = 1; step <= end; ++step) {
    const double time = step * scene.time.step;
    simulation->population.before_step(time);
    simulation->stepper.step(measuring->wants_forces(step, false));
    measuring->after_step(step, time, false);
    if (step != end / 2) continue;
    const std::string state = simulation->save();
    const MeasuringState saved = measuring->save();
    if (interrupted) measuring.reset();
    simulation.reset();
    simulation.emplace(scene, 1, state);
    interrupted ? static_cast<void>(measuring.emplace(scene, *simulation, folder, saved)) : measuring->go_on_in(*simulation);
  }
  measuring->finish(scene.time.duration);
  return parsed(read_file(folder.file("measurements/" + name + ".csv")));
}

constexpr const char* kFloor = R"(
[[part]]
name = "floor"
shape = "plane"
)";

constexpr const char* kFarFloor = R"(
[[part]]
name = "floor"
shape = "plane"
position = [0, 0, -5]
)";

constexpr const char* kBelt = R"(
[[part]]
name = "belt"
shape = "plane"
[[part.motion]]
kind = "conveyor"
velocity = [0.4, 0, 0]
)";

constexpr double kCoefficient = 2e-4;
constexpr double kHardness = 1.5e9;  // Pa

std::string wear_every(double interval, const std::string& more = "") {
  return "[[measurement]]\nkind = \"wear\"\ncoefficient = 2e-4\nhardness = 1.5e9\ninterval = " + shortest(interval) + "\n" + more;
}

double grain_mass(const Scene& scene, std::size_t kind) { return mass_of(scene.kinds[kind].kind); }

}  // namespace

TEST_CASE("wear: a block that slides to rest wears k / H m v^2 / (2 mu) off the floor, whatever its mass does on the way") {
  constexpr double kFriction = 0.3;
  constexpr double kSpeed = 0.5;
  const double way = kSpeed * kSpeed / (2 * kFriction * kGravity);  // 42 mm
  const Scene scene = with_grains(open_scene(kFloor + wear_every(0.3), 0.3, kGravity, kFriction),
                                  {moving(kDie, {0, 0, 6e-3 - 1e-6}, {kSpeed, 0, 0})});
  const MeasuredTable table = run(scene, "wear");
  REQUIRE(table.rows.size() == 1);
  CHECK(table.text("wall") == "floor");
  CHECK(table.number("force_times_distance_Nm") == relative(grain_mass(scene, kDie) * kGravity * way).epsilon(0.01));
  CHECK(table.number("worn_volume_m3") ==
        relative(kCoefficient / kHardness * table.number("force_times_distance_Nm")).epsilon(1e-12));
}

TEST_CASE(
    "wear: without friction a block wears k / H m g v t off a standing floor, and as much off a belt below a standing block") {
  for (const bool is_on_belt : {true, false}) {
    CAPTURE(is_on_belt);
    const Scene scene = with_grains(open_scene((is_on_belt ? kBelt : kFloor) + wear_every(0.2), 0.2, kGravity, kNoFriction),
                                    {moving(kDie, {0, 0, 6e-3 - 1e-6}, {is_on_belt ? 0 : 0.4, 0, 0})});
    const MeasuredTable table = run(scene, "wear");
    CHECK(table.number("worn_volume_m3") ==
          relative(kCoefficient / kHardness * grain_mass(scene, kDie) * kGravity * 0.4 * 0.2).epsilon(0.01));
  }
}

TEST_CASE("wear: grains that ride on a belt or a turntable, or roll, wear next to nothing off it") {
  const std::string turntable = R"(
[[part]]
name = "disc"
shape = "plane"
[[part.motion]]
kind = "rotation"
axis = [0, 0, 1]
point = [0, 0, 0]
rpm = 60
)";
  const double spin = 2 * std::numbers::pi;
  const double radius = 0.02;
  const auto part_worn = [&](const std::string& part, const StartGrain& grain, double speed) {
    const Scene scene = with_grains(open_scene(part + wear_every(0.2), 0.2), {grain});
    const double all = grain_mass(scene, grain.kind) * kGravity * speed * 0.2;  // of a grain that slides at this speed
    return run(scene, "wear").number("force_times_distance_Nm") / all;
  };
  CHECK(part_worn(kBelt, moving(kDie, {0, 0, 6e-3 - 1e-6}, {0.4, 0, 0}), 0.4) < 1e-3);
  StartGrain rider = moving(kDie, {radius, 0, 6e-3 - 1e-6}, {0, spin * radius, 0});
  rider.angular_velocity = {0, 0, spin};
  CHECK(part_worn(turntable, rider, spin * radius) < 1e-3);
  StartGrain ball = moving(kPea, {0, 0, kPeaRadius}, {0.3, 0, 0});
  ball.angular_velocity = {0, 0.3 / kPeaRadius, 0};
  CHECK(part_worn(kFloor, ball, 0.3) < 1e-3);
}

TEST_CASE("wear: each triangle has the wear of the way across it") {
  const TemporaryFolder folder;
  // Two squares of 40 mm side by side along x, of two triangles each; the diagonals run from low x and y to high ones.
  const std::string mesh =
      folder.write("strip.obj",
                   "v -0.02 -0.02 0\nv 0.02 -0.02 0\nv 0.06 -0.02 0\nv -0.02 0.02 0\nv 0.02 0.02 0\nv 0.06 0.02 "
                   "0\nf 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\n");
  const std::string strip = "\n[[part]]\nname = \"strip\"\nshape = \"mesh\"\nunit = \"m\"\nfile = \"" + mesh + "\"\n";
  const Scene scene = with_grains(open_scene(strip + wear_every(0.1, "per = \"triangle\"\n"), 0.1, kGravity, kNoFriction),
                                  {moving(kPea, {0, 0.01, kPeaRadius - 1e-6}, {0.4, 0, 0})});
  // From x = 0 to 40 mm at y = 10 mm: the diagonals are at x = 10 and 50 mm, the edge between the squares at 20 mm.
  const std::array<double, 4> ways = {0.01, 0.01, 0, 0.02};
  const double weight = grain_mass(scene, kPea) * kGravity;
  const MeasuredTable table = run(scene, "wear");
  double sum = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto triangle = static_cast<std::size_t>(table.number("triangle", row));
    REQUIRE(triangle < ways.size());
    CAPTURE(triangle);
    CHECK(std::abs(table.number("force_times_distance_Nm", row) - weight * ways[triangle]) < 0.02 * weight * 0.04);
    CHECK(table.number("area_m2", row) == relative(8e-4).epsilon(1e-6));
    CHECK(table.number("worn_depth_m", row) == relative(table.number("worn_volume_m3", row) / 8e-4).epsilon(1e-6));
    sum += table.number("force_times_distance_Nm", row);
  }
  CHECK(sum == relative(weight * 0.04).epsilon(0.01));
}

TEST_CASE("wear: VTK and glTF files show the wear of each triangle of a mesh, and all triangles have the wear of the wall") {
  const TemporaryFolder folder;
  // The strip of the test above, and a box, whose triangles are those of its picture alone.
  const std::string mesh =
      folder.write("strip.obj",
                   "v -0.02 -0.02 0\nv 0.02 -0.02 0\nv 0.06 -0.02 0\nv -0.02 0.02 0\nv 0.02 0.02 0\nv 0.06 0.02 "
                   "0\nf 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\n");
  const std::string strip =
      "[[part]]\nname = \"block\"\nshape = \"box\"\nsize = [0.01, 0.01, 0.01]\nposition = [1, 1, 1]\n"
      "[[part]]\nname = \"strip\"\nshape = \"mesh\"\nunit = \"m\"\ntwo_sided = true\nfile = \"" +
      mesh + "\"\n";
  Scene scene = with_grains(
      open_scene(strip + wear_every(0.1) + wear_every(0.1, "name = \"worn\"\nper = \"triangle\"\n"), 0.1, kGravity, kNoFriction),
      {moving(kDie, {0, 0, 6e-3 - 1e-6}, {0.4, 0, 0})});
  scene.pictures = {"vtk", "glb"};
  OutputFolder results(folder.path() / "out", scene.name, result_names());
  Checkpoints checkpoints(results, scene, 0);
  StepwiseRun steps(scene, 1, StepwiseRun::Files{results, checkpoints});
  steps.advance(scene.time.steps(), nullptr);
  steps.finish();
  const std::filesystem::path out = results.path();

  const std::string last = read_file(out / "vtk" / "container_000010.vtp");
  const std::vector<double> volumes = read_array(last, "worn_volume"), depths = read_array(last, "worn_depth");
  const std::size_t edges = read_array(last, "offsets").size();
  REQUIRE(volumes.size() == edges + 12 + 4);  // the triangles of the block come before those of the strip
  REQUIRE(depths.size() == volumes.size());
  const MeasuredTable table = parsed(read_file(out / "measurements" / "worn.csv"));
  double sum = 0;
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    if (k < edges + 12) CHECK(volumes[k] == 0);
    CHECK(std::abs(8e-4 * depths[k] - volumes[k]) <= 1e-6 * volumes[k]);
    sum += volumes[k];
  }
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    CHECK(volumes[edges + 12 + static_cast<std::size_t>(table.number("triangle", row))] ==
          relative(table.number("worn_volume_m3", row)).epsilon(1e-9));
  }
  const MeasuredTable total = parsed(read_file(out / "measurements" / "wear.csv"));
  CHECK(sum == relative(total.number("worn_volume_m3", 1)).epsilon(1e-12));
  CHECK(sum == relative(kCoefficient / kHardness * grain_mass(scene, kDie) * kGravity * 0.4 * 0.1).epsilon(0.01));
}

TEST_CASE("wear: in a periodic cell the area and centroid of a triangle belong to its part in the cell") {
  const TemporaryFolder folder;
  // 80 mm along x; along y 30 mm longer than the cell at both ends. The diagonal is at x = 20 mm in the middle.
  // Meshes have numbers of single precision.
  const std::string mesh =
      folder.write("strip.obj", "v -0.02 -0.03 0\nv 0.06 -0.03 0\nv 0.06 0.13 0\nv -0.02 0.13 0\nf 1 2 3\nf 1 3 4\n");
  const std::string strip =
      "\n[periodic]\ny = [0, 0.1]\n[[part]]\nname = \"strip\"\nshape = \"mesh\"\nunit = \"m\"\nfile = \"" + mesh + "\"\n";
  const Scene scene = with_grains(open_scene(strip + wear_every(0.1, "per = \"triangle\"\n"), 0.1, kGravity, kNoFriction),
                                  {moving(kPea, {0, 0.05, kPeaRadius - 1e-6}, {0.4, 0, 0})});
  const MeasuredTable table = run(scene, "wear");
  REQUIRE(table.rows.size() == 2);
  for (std::size_t row = 0; row < 2; ++row) {
    // A trapezium: 80 mm x 100 mm cut by a diagonal from 15 to 65 mm of x, whose halves are alike.
    const double sign = table.number("triangle", row) == 0 ? 1 : -1;
    CHECK(table.number("area_m2", row) == relative(4e-3).epsilon(1e-6));
    const double shift_y = 0.1 * (0.065 - 0.015) / (6 * (0.065 + 0.015));
    CHECK(table.number("y_m", row) == relative(0.05 - sign * shift_y).epsilon(1e-6));
    CHECK(table.number("worn_depth_m", row) == relative(table.number("worn_volume_m3", row) / 4e-3).epsilon(1e-6));
  }
}

TEST_CASE("wear: triangles of a wall that is no mesh are refused") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string sheet = "[[part]]\nname = \"sheet\"\nshape = \"mesh\"\nunit = \"m\"\nfile = \"" + mesh + "\"\n";
  const auto complaint_of = [](const std::string& parts, const std::string& surfaces) {
    return complaint(open_scene(parts + wear_every(0.1, "per = \"triangle\"\n" + surfaces), 0.1));
  };
  check_says(complaint_of(kFloor, ""), {"measurement.per is \"triangle\"", "without a wall that is a mesh", "allowed: wall"});
  check_says(complaint_of(kFloor + sheet, "surfaces = [\"sheet\", \"floor\"]\n"),
             {"measurement.surfaces has \"floor\"", "no mesh", "allowed: sheet, or per = \"wall\""});
  CHECK(complaint_of(kFloor + sheet, "surfaces = [\"sheet\"]\n").empty());
  CHECK(complaint_of(kFloor + sheet, "").empty());
}

TEST_CASE("wear: a hardness in GPa, MPa or HV is refused") {
  for (const char* const hardness : {"1.5", "1500", "200"}) {
    const std::string text = complaint(open_scene(kFloor + replaced(wear_every(0.1), "1.5e9", hardness), 0.1));
    check_says(text, {"measurement.hardness is", hardness, "1e+12] Pa"});
  }
}

TEST_CASE("residence: grains that fly through a region stay for its length over their speed, with mean and deviation") {
  const std::string region = R"(
[[measurement]]
kind = "residence"
lower = [0.0101, -1, -1]
upper = [0.0502, 1, 1]
interval = 0.4
[[measurement]]
kind = "residence"
name = "visits"
per = "visit"
lower = [0.0101, -1, -1]
upper = [0.0502, 1, 1]
interval = 0.1
)";
  const std::array<double, 3> speeds = {0.4, 0.25, 0.2};
  constexpr double kLength = 0.0401;
  std::vector<StartGrain> grains;
  double mean = 0;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    grains.push_back(moving(kPea, {0, 0.01 * static_cast<double>(i), 0}, {speeds[i], 0, 0}));
    mean += kLength / speeds[i] / 3;
  }
  grains.push_back(moving(kDie, {0.02, 0.05, 0}, {0, 0, 0}));    // inside from the start, for ever
  grains.push_back(moving(kDie, {0.03, 0.07, 0}, {0.4, 0, 0}));  // inside from the start
  grains.push_back(moving(kDie, {0.06, 0.09, 0}, {-1, 0, 0}));   // through it backwards
  double squares = 0;
  for (const double speed : speeds) squares += std::pow(kLength / speed - mean, 2);
  const Scene scene = with_grains(open_scene(kFarFloor + region, 0.4, 0), grains);
  const MeasuredTable table = run(scene, "residence");
  REQUIRE(table.rows.size() == 4);  // two kinds, at the start and at the end
  CHECK(table.number("inside", 1) == 2);
  CHECK(table.text("mean_residence_s", 0).empty());
  CHECK(table.text("grain", 2) == "pea");
  CHECK(table.number("entered", 2) == 3);
  CHECK(table.number("left", 2) == 3);
  CHECK(table.number("mean_residence_s", 2) == relative(mean).epsilon(1e-6));
  CHECK(table.number("deviation_s", 2) == relative(std::sqrt(squares / 2)).epsilon(1e-6));
  CHECK(table.number("inside", 3) == 1);
  CHECK(table.number("residences", 3) == 2);
  CHECK(table.number("mean_residence_s", 3) == relative((0.0202 / 0.4 + kLength) / 2).epsilon(1e-6));

  const MeasuredTable visits = run(scene, "visits");
  REQUIRE(visits.rows.size() == 5);
  for (std::size_t row = 0; row < visits.rows.size(); ++row) {
    const auto grain = static_cast<std::size_t>(visits.number("body", row));
    if (grain >= speeds.size()) continue;
    CHECK(visits.number("entered_s", row) == relative(0.0101 / speeds[grain]).epsilon(1e-6));
    CHECK(visits.number("left_s", row) == relative(0.0502 / speeds[grain]).epsilon(1e-6));
    CHECK(visits.number("residence_s", row) == relative(kLength / speeds[grain]).epsilon(1e-6));
  }
}

TEST_CASE("residence: a grain that crosses a region, or the gap between its images, within a step visits it once for each") {
  const auto visits = [](double lower, double upper) {
    const std::string region = "[periodic]\nx = [0, 0.1]\n[[measurement]]\nkind = \"residence\"\nper = \"visit\"\nlower = [" +
                               shortest(lower) + ", -1, -1]\nupper = [" + shortest(upper) + ", 1, 1]\ninterval = 0.5\n";
    return run(with_grains(open_scene(kFarFloor + region, 0.5, 0), {moving(kPea, {0.05, 0, 0}, {0.4, 0, 0})}), "residence");
  };
  const MeasuredTable thin = visits(0.0101, 0.0102);  // a step is 0.4 mm long or longer
  REQUIRE(thin.rows.size() == 2);
  CHECK(thin.number("entered_s", 1) == relative(0.1601 / 0.4).epsilon(1e-6));
  for (const std::size_t row : {0U, 1U}) CHECK(thin.number("residence_s", row) == relative(1e-4 / 0.4).epsilon(1e-6));

  const MeasuredTable gap = visits(0, 0.0999);
  REQUIRE(gap.rows.size() == 2);
  CHECK(gap.number("left_s", 0) == relative(0.0499 / 0.4).epsilon(1e-6));
  CHECK(gap.number("residence_s", 1) == relative(0.0999 / 0.4).epsilon(1e-6));
}

TEST_CASE("residence: a grain that a sink removes has left, and one that was inside at `from` has no time") {
  const std::string region = R"(
[[sink]]
name = "bin"
corner = [0.04, -1, -1]
size = [0.1, 2, 2]
[[measurement]]
kind = "residence"
lower = [0.01, -1, -1]
upper = [0.2, 1, 1]
interval = 0.05
from = 0.05
)";
  const Scene scene = with_grains(open_scene(kFarFloor + region, 0.15, 0),
                                  {moving(kPea, {0, 0, 0}, {0.4, 0, 0}), moving(kPea, {0.02, 0.02, 0}, {0.1, 0, 0})});
  const MeasuredTable table = run(scene, "residence");
  REQUIRE(table.rows.size() == 6);  // at 0.05, 0.1 and 0.15 s
  CHECK(table.number("inside", 0) == 2);
  CHECK(table.number("entered", 4) == 0);
  CHECK(table.number("left", 4) == 1);
  CHECK(table.number("residences", 4) == 0);
}

TEST_CASE("tables of events have those after the last sample, too") {
  const std::string tables = R"(
[[measurement]]
kind = "passage"
name = "grains"
per = "grain"
axis = "x"
at = 0.0301
interval = 0.15
[[measurement]]
kind = "residence"
name = "visits"
per = "visit"
lower = [-0.01, -1, -1]
upper = [0.0301, 1, 1]
interval = 0.15
)";
  const Scene scene = with_grains(open_scene(kFarFloor + tables, 0.2, 0), {moving(kPea, {0, 0, 0}, {0.4, 0, 0}),        // at 75 ms
                                                                           moving(kDie, {0, 0.03, 0}, {0.18, 0, 0})});  // at 167 ms
  for (const bool interrupted : {false, true}) {
    for (const char* name : {"grains", "visits"}) {
      const MeasuredTable table = run(scene, name, interrupted);
      REQUIRE(table.rows.size() == 2);
      CHECK(table.number(name == std::string("grains") ? "time_s" : "left_s", 1) == relative(0.0301 / 0.18).epsilon(1e-6));
    }
  }
}

TEST_CASE("passage: grains pass a plane when they do in closed form, in both directions and within its window") {
  const std::string planes = R"(
[[measurement]]
kind = "passage"
axis = "x"
at = 0.0301
interval = 0.1
[[measurement]]
kind = "passage"
name = "grains"
per = "grain"
axis = "x"
at = 0.0301
lower = [0, -1, -1]
upper = [0.001, 0.05, 1]
interval = 0.1
)";
  const Scene scene =
      with_grains(open_scene(kFarFloor + planes, 0.2, 0), {moving(kPea, {0, 0, 0}, {0.4, 0.1, 0}),       // at 75.25 ms
                                                           moving(kPea, {0.05, 0.06, 0}, {-0.2, 0, 0}),  // at 99.5 ms, backwards
                                                           moving(kDie, {0, 0.03, 0}, {0.2, 0, 0})});    // at 150.5 ms
  const MeasuredTable table = run(scene, "passage");
  REQUIRE(table.rows.size() == 6);
  CHECK(table.text("kg_per_s", 0).empty());
  CHECK(table.number("forward", 2) == 1);
  CHECK(table.number("backward", 2) == 1);
  CHECK(table.number("grains_per_s", 2) == 0);
  CHECK(table.number("forward", 3) == 0);
  CHECK(table.number("forward", 5) == 1);
  CHECK(table.number("forward_kg", 5) == relative(grain_mass(scene, kDie)).epsilon(1e-12));
  CHECK(table.number("kg_per_s", 5) == relative(grain_mass(scene, kDie) / 0.1).epsilon(1e-9));

  const MeasuredTable grains = run(scene, "grains");
  REQUIRE(grains.rows.size() == 2);  // the second is beside the window
  CHECK(grains.number("time_s", 0) == relative(0.0301 / 0.4).epsilon(1e-6));
  CHECK(grains.number("y_m", 0) == relative(0.0301 / 4).epsilon(1e-6));
  CHECK(grains.number("direction", 0) == 1);
  CHECK(grains.text("grain", 1) == "die");
  CHECK(grains.number("time_s", 1) == relative(0.0301 / 0.2).epsilon(1e-6));
}

TEST_CASE("passage: grains that land on the plane at the end of a step pass it once, whatever the rounding") {
  const std::string plane = "[[measurement]]\nkind = \"passage\"\naxis = \"x\"\nat = 0.3\ninterval = 0.1\n";
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    std::vector<StartGrain> grains;
    for (int i = 0; i < 60; ++i) {
      for (int steps = 20; steps < 25; ++steps) {
        const double speed = sign * (0.1 + 0.01 * i);
        grains.push_back(moving(kPea, {0.3 - speed * 5e-4 * (i + steps), 0.01 * i, 0.01 * steps}, {speed, 0, 0}));
      }
    }
    const MeasuredTable table = run(with_grains(open_scene(kFarFloor + plane, 0.1, 0), grains), "passage");
    CHECK(table.number("forward", 2) == (sign > 0 ? 300 : 0));
    CHECK(table.number("backward", 2) == (sign > 0 ? 0 : 300));
  }
}

TEST_CASE("damping takes neither passages nor wear: ODE damps velocities after it has moved the bodies") {
  // A damped velocity v falls by exp(-damping t), and the grain goes on by the sum of step v over the steps.
  constexpr double kDamping = 200;  // 1/s, a tenth in each step
  constexpr double kStep = 5e-4;
  constexpr double kSpeed = 4;
  const double whole = kSpeed * kStep / -std::expm1(-kDamping * kStep);  // m, to rest
  const std::string damping = "[damping]\nlinear = 200\nangular = 200\n";
  const std::string plane = "[[measurement]]\nkind = \"passage\"\naxis = \"x\"\nat = 0\ninterval = 0.1\n";
  std::vector<StartGrain> grains;
  grains.reserve(200);
  for (int i = 0; i < 200; ++i) grains.push_back(moving(kPea, {-0.9 * whole * (i + 1) / 200, 0.01 * i, 0}, {kSpeed, 0, 0}));
  const MeasuredTable passages = run(with_grains(open_scene(kFarFloor + plane + damping, 0.1, 0), grains), "passage");
  CHECK(passages.number("forward", 2) == 200);

  const Scene slide = with_grains(open_scene(kFloor + wear_every(0.1) + damping, 0.1, kGravity, kNoFriction),
                                  {moving(kDie, {0, 0, 6e-3 - 1e-6}, {kSpeed / 10, 0, 0})});
  CHECK(run(slide, "wear").number("force_times_distance_Nm") ==
        relative(grain_mass(slide, kDie) * kGravity * whole / 10).epsilon(0.01));
}

TEST_CASE("mixing: halves that change places stay apart by Lacey's index, and grains that interleave are mixed") {
  const std::string section = R"(
[[measurement]]
kind = "mixing"
axis = "x"
at = 0.04
lower = [0, 0, -1]
upper = [0.08, 0.08, 1]
cells = [4, 1, 1]
interval = 0.1
)";
  for (const bool interleave : {false, true}) {
    CAPTURE(interleave);
    std::vector<StartGrain> grains;
    for (int i = 0; i < 8; ++i) {
      for (int k = 0; k < 4; ++k) {
        // All move by half of the width, or every second one does, into the other half and past those that come.
        const bool moves = !interleave || k % 2 == 0;
        const double speed = moves ? (i < 4 ? 0.4 : -0.4) : 0;
        grains.push_back(moving(kPea, {0.005 + 0.01 * i, 0.01 + 0.02 * k, i < 4 ? 0.0 : 0.02}, {speed, 0, 0}));
      }
    }
    const MeasuredTable table = run(with_grains(open_scene(kFarFloor + section, 0.1, 0), grains), "mixing");
    REQUIRE(table.rows.size() == 2);
    CHECK(table.number("grains", 0) == 32);
    CHECK(table.number("fraction", 0) == 0.5);
    CHECK(table.number("lacey", 0) == doctest::Approx(0));
    CHECK(table.number("variance", 1) == doctest::Approx(interleave ? 0 : 0.25));
    CHECK(table.number("lacey", 1) == doctest::Approx(interleave ? 0.25 / (0.25 - 0.25 * 3 / 31) : 0));
  }
}

TEST_CASE("a grain of a feeder counts from where it is inserted, also if it is elsewhere after its first step") {
  // The grains enter at x = 3 to 9 mm, and move by 20 mm in a step.
  const std::string sections = R"(
[[feeder]]
name = "f"
corner = [0, 0, 0.2]
size = [0.012, 0.1, 0.05]
velocity = [40, 0, 0]
grains_per_second = 200
[[feeder.grain]]
name = "pea"
fraction = 1
[[measurement]]
kind = "mixing"
axis = "x"
at = 0.0125
lower = [-9, -9, -9]
upper = [9, 9, 9]
cells = [1, 1, 1]
interval = 0.05
[[measurement]]
kind = "passage"
axis = "x"
at = 0.0125
interval = 0.05
)";
  const Scene scene = with_grains(open_scene(kFarFloor + sections, 0.05, 0),
                                  {moving(kDie, {0.05, 0.02, 0}, {0, 0, 0}), moving(kDie, {0.05, 0.06, 0}, {0, 0, 0})});
  const MeasuredTable passages = run(scene, "passage");
  CHECK(passages.number("forward", 2) == 10);
  const MeasuredTable mixed = run(scene, "mixing");
  CHECK(mixed.number("grains", 1) == 12);
  CHECK(mixed.number("fraction", 1) == relative(10.0 / 12).epsilon(1e-12));
}

TEST_CASE("measurements that follow a run resume to the bit") {
  const std::string sections = wear_every(0.01) + R"(
[[measurement]]
kind = "residence"
lower = [0.05, -1, -1]
upper = [0.07, 1, 1]
per = "visit"
interval = 0.1
[[measurement]]
kind = "passage"
axis = "x"
at = 0.03
per = "grain"
interval = 0.1
[[measurement]]
kind = "mixing"
axis = "x"
at = -0.01
lower = [-1, -1, -1]
upper = [1, 1, 1]
cells = [100, 1, 1]
interval = 0.05
)";
  std::vector<StartGrain> grains;
  grains.reserve(8);
  for (int i = 0; i < 8; ++i) grains.push_back(moving(i % 2 == 0 ? kPea : kDie, {-0.03 + 0.015 * i, 0, 6e-3}, {0.3, 0, 0}));
  const Scene scene = with_grains(open_scene(kBelt + sections, 0.2), grains);
  for (const char* name : {"wear", "residence", "passage", "mixing"}) {
    CAPTURE(name);
    const MeasuredTable whole = run(scene, name);
    CHECK(whole.rows.size() > 1);
    CHECK(run(scene, name, true).rows == whole.rows);
  }
}

TEST_CASE("measurements that follow a run: mistakes are told with what is allowed") {
  const std::string start = std::string(kSceneText) + "[[measurement]]\ninterval = 0.01\n";
  const std::string box = "lower = [0, 0, 0]\nupper = [1, 1, 1]\n";
  const std::vector<std::pair<std::string, std::vector<const char*>>> mistakes = {
      {"kind = \"wear\"\nhardness = 1e9\n", {"measurement.coefficient is missing", "(0, 1]"}},
      {"kind = \"wear\"\ncoefficient = 2\nhardness = 1e9\n", {"measurement.coefficient is 2", "(0, 1]"}},
      {"kind = \"wear\"\ncoefficient = 1e-3\nhardness = 0\n", {"measurement.hardness is 0", "[10000, 1e+12] Pa"}},
      {"kind = \"wear\"\ncoefficient = 1e-3\nhardness = 1e9\nsurfaces = [\"flor\"]\n", {"surfaces[0]", "did you mean \"floor\"?"}},
      {"kind = \"wear\"\ncoefficient = 1e-3\nhardness = 1e9\nsurfaces = [\"floor\", \"floor\"]\n",
       {"surfaces[1] is the string \"floor\" for the second time; allowed"}},
      {"kind = \"wear\"\ncoefficient = 1e-3\nhardness = 1e9\nper = \"grain\"\n",
       {"measurement.per is \"grain\"", "wall, triangle"}},
      {"kind = \"residence\"\n", {"measurement.lower is missing"}},
      {"kind = \"residence\"\nper = \"grain\"\n" + box, {"measurement.per is \"grain\"", "sample, visit"}},
      {"kind = \"passage\"\naxis = \"x\"\n", {"measurement.at is missing", "m"}},
      {"kind = \"passage\"\naxis = \"w\"\nat = 0\n", {"measurement.axis is \"w\"", "x, y, z"}},
      {"kind = \"passage\"\naxis = \"x\"\nat = 0\nlower = [0, 0, 0]\n", {"measurement.upper is missing"}},
      {"kind = \"mixing\"\naxis = \"x\"\nat = 0\ncells = [1, 1, 1]\n", {"measurement.lower is missing"}},
      {"kind = \"mixing\"\naxis = \"x\"\nat = 0\n" + box, {"measurement.cells is missing"}},
  };
  for (const auto& [section, says] : mistakes) check_says(complaint(start + section), says);
  const std::string plane = "kind = \"passage\"\naxis = \"x\"\nat = 0\n";
  check_says(complaint(start + plane + "from = 0.032\nuntil = 0.038\n"),
             {"measurement.interval is 0.01", "no sample", "from 0.032 to 0.038 s"});
  check_says(complaint(start + plane + "from = 0.0301\nuntil = 0.0304\n"), {"no sample"});
  check_says(complaint(start + "kind = \"wear\"\ncoefficient = 1e-3\nhardness = 1e9\nuntil = 0.005\n"),
             {"no sample", "from 5e-04 to 0.005 s"});
  CHECK(complaint(start + plane + "until = 0.005\n").empty());  // at 0
  CHECK(complaint(start + plane + "from = 0.025\nuntil = 0.03\n").empty());
  CHECK(complaint(start + "kind = \"mixing\"\naxis = \"x\"\nat = 0\ncells = [2, 2, 2]\n" + box).empty());
}
