// Measurements of the grains themselves against closed forms.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "measured.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

constexpr const char* kRods = "kind = \"nematic_order\"\ngrain = \"rod\"\naxis = \"longest\"\n";

Placement rod_about_z(double angle) { return {kRod, {0.02, 0.02, 0.02}, {std::cos(angle / 2), 0, 0, std::sin(angle / 2)}}; }

}  // namespace

TEST_CASE("measurements: aligned rods have order 1, rods in a plane 1/4, and rods at random none within its error") {
  const Scene scene = scene_with(kRods);
  const std::vector<Placement> along_y(7, upright(kRod, 0.02, 0.02, 0.02));
  const MeasuredTable aligned = measure(scene, World(scene, along_y));
  CHECK(aligned.number("grains") == 7);
  CHECK(aligned.number("order") == relative(1).epsilon(1e-12));
  CHECK(std::abs(aligned.number("director_y")) == relative(1).epsilon(1e-12));

  constexpr int kDirections = 12;
  std::vector<Placement> flat;
  flat.reserve(kDirections);
  for (int i = 0; i < kDirections; ++i) flat.push_back(rod_about_z(std::numbers::pi * i / kDirections));
  const MeasuredTable planar = measure(scene, World(scene, flat));
  CHECK(planar.number("order") == relative(0.25).epsilon(1e-9));
  CHECK(planar.number("biaxiality") == relative(0.75).epsilon(1e-9));

  constexpr int kRodsAtRandom = 2000;
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  std::vector<Placement> any;
  any.reserve(kRodsAtRandom);
  for (int i = 0; i < kRodsAtRandom; ++i) {
    any.push_back({kRod, {0.02, 0.02, 0.02}, {normal(generator), normal(generator), normal(generator), normal(generator)}});
  }
  // The squares of the three eigenvalues sum to 3 / (2 N) in the mean; the largest is at most sqrt(2/3) of the root.
  CHECK(measure(scene, World(scene, any)).number("order") < 2 * std::sqrt(1.0 / kRodsAtRandom));
}

TEST_CASE("measurements: grains apart have Lacey's index 0, and grains in any order 1 in the mean") {
  const Scene scene = scene_with(
      "kind = \"segregation\"\ngrains = [\"pea\", \"die\"]\nlower = [0, 0, 0]\nupper = [0.04, 0.04, 0.04]\ncells = [2, 2, 2]\n");
  std::vector<std::size_t> kinds;
  std::vector<Point> points;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        points.push_back({0.005 + 0.01 * i, 0.005 + 0.01 * j, 0.005 + 0.01 * k});
        kinds.push_back(i < 2 ? kPea : kDie);
      }
    }
  }
  const auto index = [&] {
    std::vector<Placement> placements;
    for (std::size_t i = 0; i < points.size(); ++i) placements.push_back({kinds[i], points[i], {1, 0, 0, 0}});
    return measure(scene, World(scene, placements)).number("lacey");
  };
  CHECK(std::abs(index()) < 1e-12);
  std::mt19937 generator(2);
  constexpr int kDraws = 300;
  double mean = 0;
  double square = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::ranges::shuffle(kinds, generator);
    const double one = index();
    mean += one / kDraws;
    square += one * one / kDraws;
  }
  const double error = std::sqrt((square - mean * mean) / (kDraws - 1));
  CHECK(error < 0.01);
  CHECK(std::abs(mean - 1) < 3 * error);
}

TEST_CASE("measurements: a rigid rotation has its velocity field on the grid and no temperature") {
  const Scene scene = scene_with("kind = \"grid\"\nlower = [0, 0, 0]\nupper = [0.04, 0.04, 0.02]\ncells = [2, 2, 1]\n");
  std::vector<Placement> placements;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < 2; ++k) placements.push_back(upright(kPea, 0.04 * (i + 0.5) / 6, 0.04 * (j + 0.5) / 6, 0.005 + 0.01 * k));
    }
  }
  const World world(scene, placements);
  constexpr double kSpin = 3;  // rad/s, about the z-axis
  for (const Grain& grain : world.grains())
    dBodySetLinearVel(grain.body, -kSpin * grain.position()[1], kSpin * grain.position()[0], 0);
  const MeasuredTable table = measure(scene, world);
  REQUIRE(table.rows.size() == 4);
  for (std::size_t cell = 0; cell < 4; ++cell) {
    CHECK(table.number("grains", cell) == 18);
    CHECK(table.number("velocity_x_m/s", cell) == relative(-kSpin * table.number("y_m", cell)).epsilon(1e-9));
    CHECK(table.number("velocity_y_m/s", cell) == relative(kSpin * table.number("x_m", cell)).epsilon(1e-9));
    // In a cell of 20 mm with rows at 1/6, 1/2 and 5/6 x and y vary by 2/3 (20 mm / 3)^2 each.
    CHECK(table.number("velocity_variance_m2/s2", cell) ==
          relative(kSpin * kSpin * 2 * (2.0 / 3) * std::pow(0.02 / 3, 2) / 3).epsilon(1e-9));
    CHECK(table.number("granular_temperature_m2/s2", cell) < 1e-15);
    CHECK(table.number("volume_fraction", cell) ==
          relative(18 * 4.0 / 3 * std::numbers::pi * 2.7e-8 / (0.02 * 0.02 * 0.02)).epsilon(1e-9));
    CHECK(table.number("density_kg/m3", cell) == relative(1200 * table.number("volume_fraction", cell)).epsilon(1e-9));
  }
}

TEST_CASE("measurements: velocities at random have their variance as temperature, in a shear flow too") {
  const Scene scene = scene_with("kind = \"grid\"\nlower = [0, 0, 0]\nupper = [0.04, 0.04, 0.04]\ncells = [1, 1, 1]\n");
  std::mt19937 generator(8);
  std::normal_distribution<double> normal(0, 0.1);
  std::uniform_real_distribution<double> anywhere(0.003, 0.037);
  constexpr int kWorlds = 40;
  constexpr int kGrains = 12;  // few: without their degrees of freedom the mean would be 8/12 of it
  double mean = 0;
  for (int i = 0; i < kWorlds; ++i) {
    std::vector<Placement> placements;
    for (int k = 0; k < kGrains; ++k) {
      const double x = anywhere(generator);
      const double y = anywhere(generator);
      placements.push_back(upright(kPea, x, y, anywhere(generator)));
    }
    const World world(scene, placements);
    for (const Grain& grain : world.grains()) {
      const double vx = normal(generator);
      const double vy = normal(generator);
      dBodySetLinearVel(grain.body, vx + 50 * grain.position()[2], vy, normal(generator));
    }
    mean += measure(scene, world).number("granular_temperature_m2/s2") / kWorlds;
  }
  const double error = std::sqrt(2.0 / (3 * (kGrains - 4) * kWorlds));  // relative, of a chi-squared mean
  CHECK(mean == relative(0.01).epsilon(3 * error));
}

TEST_CASE("measurements: the surface of a sloping layer has its angle, about both axes") {
  const std::array<const char*, 2> about = {"y", "x"};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Scene scene = scene_with(std::string("kind = \"surface\"\nlower = [0, 0, 0]\nupper = [0.05, 0.05, 0.1]\naxis = \"") +
                                   about[axis] + "\"\n");
    constexpr double kSlope = 0.3;
    std::vector<Placement> placements;
    for (int i = 0; i <= 25; ++i) {
      for (int j = 0; j <= 25; ++j) {
        const double x = 0.002 * i;
        const double y = 0.002 * j;
        placements.push_back(upright(kPea, x, y, 0.02 - kSlope * (axis == 0 ? x : y)));
      }
    }
    const MeasuredTable table = measure(scene, World(scene, placements));
    CHECK(table.number("fitted_columns") == 20);
    CHECK(table.number("angle_deg") == relative(-std::atan(kSlope) * 180 / std::numbers::pi).epsilon(0.01));
    CHECK(table.number("standard_error_deg") < 0.2);
    // The envelope of the spheres is their layer, moved by the radius along its normal, less the dents between them.
    CHECK(table.number("height_20_m") == relative(0.02 - kSlope * 0.05 * 19.5 / 40 + 3e-3 * std::hypot(1, kSlope)).epsilon(0.02));
  }
  const Scene scene = scene_with("kind = \"surface\"\nlower = [0, 0, 0]\nupper = [0.05, 0.05, 0.1]\n");
  const MeasuredTable empty = measure(scene, World(scene, {}));
  CHECK(empty.text("angle_deg").empty());
  CHECK(empty.text("height_1_m").empty());
}

TEST_CASE("measurements: mistakes are told with what is allowed") {
  const std::string start = std::string(kSceneText) + "[[measurement]]\n";
  const std::vector<std::pair<std::string, std::vector<const char*>>> mistakes = {
      {"kind = \"stres\"\ninterval = 0.01\n",
       {"measurement.kind is \"stres\"", "did you mean \"stress\"?", "allowed: contact_forces"}},
      {"kind = \"fabric\"\n", {"measurement.interval is missing", "[5e-04, 0.1] s"}},
      {"kind = \"fabric\"\ninterval = 0.00075\n", {"measurement.interval is 0.00075", "allowed: a multiple of time.step, 5e-04 s"}},
      {"kind = \"fabric\"\ninterval = 0.01\nfrom = 0.05\nuntil = 0.04\n", {"measurement.until is 0.04", "[0.05, 0.1]"}},
      {"kind = \"fabric\"\ninterval = 0.01\ncells = [1, 1, 1]\n", {"unknown key \"cells\"", "allowed: kind, name, interval"}},
      {"kind = \"fabric\"\ninterval = 0.01\nname = \"a/b\"\n", {"measurement.name is \"a/b\"", "letters, digits"}},
      {"kind = \"fabric\"\ninterval = 0.01\n[[measurement]]\nkind = \"fabric\"\ninterval = 0.01\n", {"\"fabric\" is listed twice"}},
      {"kind = \"stress\"\ninterval = 0.01\n", {"measurement.lower is missing"}},
      {"kind = \"stress\"\ninterval = 0.01\nlower = [0, 0, 0]\nupper = [1, 0, 1]\n", {"measurement.upper[1] is 0", "above"}},
      {"kind = \"part_force\"\ninterval = 0.01\nsurfaces = [\"flor\"]\n", {"surfaces[0]", "did you mean \"floor\"?"}},
      {"kind = \"part_force\"\ninterval = 0.01\nsurfaces = []\n", {"surfaces is empty", "floor"}},
      {"kind = \"grid\"\ninterval = 0.01\nlower = [0, 0, 0]\nupper = [1, 1, 1]\ncells = [1, 2.5, 1]\n",
       {"cells[1] is 2.5", "whole"}},
      {"kind = \"nematic_order\"\ninterval = 0.01\ngrain = \"pea\"\naxis = \"longest\"\n",
       {"no single longest half-axis", "allowed"}},
      {"kind = \"segregation\"\ninterval = 0.01\ngrains = [\"pea\"]\n", {"has 1 names; allowed: two"}},
      {"kind = \"discharge\"\ninterval = 0.01\n", {"measurement.kind is \"discharge\"; allowed: in hoppers"}},
  };
  for (const auto& [section, says] : mistakes) check_says(complaint(start + section), says);
  CHECK(complaint(start + "kind = \"fabric\"\ninterval = 0.01\n").empty());
}

TEST_CASE("measurements: samples are taken at multiples of the interval from the first to the last") {
  const Scene scene = scene_with("kind = \"fabric\"\nfrom = 0.0012\nuntil = 0.003\nname = \"some\"\n");
  const MeasurementRequest& request = scene.measurements.front();
  CHECK(request.name == "some");
  std::vector<int> due;
  for (int step = 0; step < 10; ++step) {
    if (request.is_due(step)) due.push_back(step);
  }
  CHECK(due == std::vector<int>{3, 4, 5, 6});
}
