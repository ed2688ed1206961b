// Measurements of contacts and their forces against closed forms.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "measured.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

constexpr double kRadius = 3e-3;
constexpr double kPeaWeight = 1200 * 4.0 / 3 * std::numbers::pi * kRadius * kRadius * kRadius * 9.81;

/// Two peas, one on top of the other.
const std::vector<Placement>& column() {
  static const std::vector<Placement> pair = {upright(kPea, 0.02, 0.03, kRadius), upright(kPea, 0.02, 0.03, 3 * kRadius)};
  return pair;
}

constexpr int kStepsToRest = 400;

constexpr double kWidth = 0.03;  // m, of a box
constexpr double kSlice = 0.01;  // m, height of a slice of its bed
constexpr std::size_t kSlices = 3;

struct BedAtRest {
  double weight;                           // N, of all grains
  double force_on_walls = 0;               // N, along z; means of samples from here on
  std::array<double, kSlices> stress{};    // Pa, along z, of a slice
  std::array<double, kSlices> expected{};  // Pa
};

/// Many grains in a box whose walls have next to no friction.
std::string smooth_box() {
  const std::string text = replaced(kSceneText, "width = [0.05, 0.06]", "width = [0.03, 0.03]");
  const std::string bed = replaced(text, "count = 5", "count = 140");
  return replaced(replaced(bed, "iterations = 20", "iterations = 100"), "coefficient = 0.4", "coefficient = 0.4\nwalls = 1e-6");
}

/// What a level transmits is the weight of the grains whose centres are above it, and the pressure (Pa) on the bed.
BedAtRest rest(const std::string& text, double pressure, int steps) {
  const Scene scene = scene_with("kind = \"stress\"\nlower = [0, 0, 0]\nupper = [0.03, 0.03, 0.03]\nslices = 3\n", text);
  const Scene walls = scene_with("kind = \"part_force\"\n", text);
  Random random(3);
  const World world(scene, place(scene, random));
  Stepper stepper(world, scene);
  for (int step = 0; step < steps; ++step) stepper.step();
  BedAtRest bed{};
  for (const Grain& grain : world.grains()) bed.weight += 9.81 * grain.mass.mass;
  constexpr int kSamples = 50;
  for (int sample = 0; sample < kSamples; ++sample) {
    stepper.step(true);
    const MeasuredTable table = measure(scene, world, &stepper);
    bed.force_on_walls += measure(walls, world, &stepper).number("force_z_N") / kSamples;
    for (std::size_t i = 0; i < kSlices; ++i) {
      bed.stress[i] += table.number("contact_zz_Pa", i) / kSamples;
      bed.expected[i] += pressure / kSamples;
      for (const Grain& grain : world.grains()) {
        const double above = std::clamp(grain.position()[2] - table.number("lower_m", i), 0.0, kSlice) / kSlice;
        bed.expected[i] += 9.81 * grain.mass.mass * above / (kWidth * kWidth) / kSamples;
      }
    }
  }
  return bed;
}

std::array<double, 4> plane_of(const World& world, const std::string& name) {
  const auto found =
      std::ranges::find(world.walls().geoms(), name, [&](dGeomID geom) { return world.walls().wall_of(geom)->name; });
  REQUIRE(found != world.walls().geoms().end());
  REQUIRE(dGeomGetClass(*found) == dPlaneClass);
  dVector4 plane;
  dGeomPlaneGetParams(*found, plane);
  return {plane[0], plane[1], plane[2], plane[3]};
}

}  // namespace

TEST_CASE("measurements: a pea at rest presses the floor with its weight, and turns it about a point") {
  const Scene scene = scene_with("kind = \"part_force\"\nsurfaces = [\"floor\"]\nabout = [0.01, 0.01, 0]\n");
  const MeasuredTable table = step_and_measure(scene, {upright(kPea, 0.02, 0.03, kRadius)}, kStepsToRest);
  CHECK(table.number("contacts") == 1);
  CHECK(table.number("force_z_N") == relative(-kPeaWeight).epsilon(1e-3));
  CHECK(table.number("torque_x_Nm") == relative(-0.02 * kPeaWeight).epsilon(1e-3));
  CHECK(table.number("torque_y_Nm") == relative(0.01 * kPeaWeight).epsilon(1e-3));
  CHECK(std::abs(table.number("force_x_N")) < 1e-6 * kPeaWeight);
}

TEST_CASE("measurements: a face on the floor is one contact with the whole weight") {
  const Scene scene = scene_with("kind = \"contact_forces\"\n");
  const World world(scene, {upright(kDie, 0.02, 0.03, 6e-3)});
  Stepper stepper(world, scene);
  for (int step = 1; step < kStepsToRest; ++step) stepper.step();
  stepper.step(true);
  const MeasuredTable table = measure(scene, world, &stepper);
  REQUIRE(table.rows.size() == 1);
  CHECK(table.number("points") >= 4);
  CHECK(table.text("kind1") == "die");
  CHECK(table.text("grain2").empty());
  CHECK(table.text("kind2") == "floor");
  CHECK(table.number("normal_z") == relative(1).epsilon(1e-12));
  CHECK(table.number("normal_force_N") == relative(world.grains()[0].mass.mass * 9.81).epsilon(1e-3));
  CHECK(table.number("x_m") == relative(0.02).epsilon(1e-3));
  CHECK(table.number("y_m") == relative(0.03).epsilon(1e-3));
}

TEST_CASE("measurements: a column of two peas has its forces, fabric and coordination") {
  const MeasuredTable forces = step_and_measure(scene_with("kind = \"contact_forces\"\n"), column(), kStepsToRest);
  REQUIRE(forces.rows.size() == 2);
  CHECK(forces.text("grain2", 0) == "1");
  CHECK(forces.number("normal_z", 0) == relative(-1).epsilon(1e-9));
  CHECK(forces.number("normal_force_N", 0) == relative(kPeaWeight).epsilon(1e-3));
  CHECK(forces.text("kind2", 1) == "floor");
  CHECK(forces.number("normal_force_N", 1) == relative(2 * kPeaWeight).epsilon(1e-3));

  const MeasuredTable fabric = step_and_measure(scene_with("kind = \"fabric\"\nwalls = true\n"), column(), kStepsToRest);
  CHECK(fabric.text("contacts") == "2");
  CHECK(fabric.number("zz") == relative(1).epsilon(1e-9));
  CHECK(fabric.number("largest") == relative(1).epsilon(1e-9));
  CHECK(std::abs(fabric.number("middle")) < 1e-9);
  CHECK(fabric.number("anisotropy") == relative(7.5).epsilon(1e-9));  // sqrt(3/2) 15/2 sqrt(2/3)
  const MeasuredTable of_grains = step_and_measure(scene_with("kind = \"fabric\"\n"), column(), kStepsToRest);
  CHECK(of_grains.text("contacts") == "1");

  const MeasuredTable hanging = step_and_measure(scene_with("kind = \"coordination\"\nleast = 2\n"), column(), kStepsToRest);
  CHECK(hanging.number("mean") == 1.5);
  CHECK(hanging.text("grains_with_1") == "1");
  CHECK(hanging.text("grains_with_2") == "1");
  // The upper pea has one contact; without it the lower one has one as well.
  CHECK(hanging.text("rattlers") == "2");
  CHECK(hanging.text("mean_without_rattlers").empty());
  const MeasuredTable lasting = step_and_measure(scene_with("kind = \"coordination\"\nleast = 1\n"), column(), kStepsToRest);
  CHECK(lasting.text("rattlers") == "0");
  CHECK(lasting.number("mean_without_rattlers") == 1.5);
  const MeasuredTable no_walls = step_and_measure(scene_with("kind = \"coordination\"\nwalls = false\n"), column(), kStepsToRest);
  CHECK(no_walls.number("mean") == 1);
}

TEST_CASE("measurements: a chain through a periodic cell has branches across its boundary") {
  constexpr std::size_t kPeas = 6;
  constexpr double kSpacing = 2 * kRadius - 1e-5;
  constexpr double kSide = kPeas * kSpacing;
  std::string text = replaced(kSceneText, "kind = \"box\"\nwidth = [0.05, 0.06]", "kind = \"periodic\"\nside = " + shortest(kSide));
  text = replaced(text, "[drop]\nheight = 0.01\ngap = 0.1\n", "");
  text = replaced(text, "[gravity]\nacceleration = [0, 0, -9.81]\n", "");
  std::vector<Placement> chain;
  for (std::size_t i = 0; i < kPeas; ++i) chain.push_back(upright(kPea, (static_cast<double>(i) + 0.2) * kSpacing, 0.01, 0.01));
  const MeasuredTable forces = step_and_measure(scene_with("kind = \"contact_forces\"\n", text), chain, 1);
  REQUIRE(forces.rows.size() == kPeas);
  double sum = 0;
  for (std::size_t i = 0; i < kPeas; ++i) {
    CHECK(forces.number("normal_force_N", i) > 0);
    sum += forces.number("normal_force_N", i);
  }
  const MeasuredTable whole = step_and_measure(scene_with("kind = \"stress\"\n", text), chain, 1);
  CHECK(whole.number("contact_xx_Pa") == relative(sum * kSpacing / (kSide * kSide * kSide)).epsilon(1e-6));
  CHECK(std::abs(whole.number("contact_zz_Pa")) < 1e-6 * whole.number("contact_xx_Pa"));
  // Each slice across the chain is crossed by every force between its ends: shares add up.
  const MeasuredTable slices = step_and_measure(scene_with("kind = \"stress\"\naxis = \"x\"\nslices = 7\n", text), chain, 1);
  double mean = 0;
  for (std::size_t i = 0; i < 7; ++i) mean += slices.number("contact_xx_Pa", i) / 7;
  CHECK(mean == relative(whole.number("contact_xx_Pa")).epsilon(1e-9));
}

TEST_CASE("measurements: the kinetic stress is that of the velocities about their mean") {
  const Scene scene = scene_with("kind = \"stress\"\nlower = [0, 0, 0]\nupper = [0.05, 0.06, 0.1]\n");
  const World world(scene, {upright(kPea, 0.01, 0.03, 0.02), upright(kPea, 0.04, 0.03, 0.02)});
  dBodySetLinearVel(world.grains()[0].body, 1.5, 0, 2);
  dBodySetLinearVel(world.grains()[1].body, 0.5, 0, 2);
  const MeasuredTable table = measure(scene, world);
  const double mass = kPeaWeight / 9.81;
  const double expected = 2 * mass * 0.25 / (0.05 * 0.06 * 0.1);
  CHECK(table.number("kinetic_xx_Pa") == relative(expected).epsilon(1e-9));
  CHECK(std::abs(table.number("kinetic_zz_Pa")) < 1e-9 * expected);
  CHECK(table.number("pressure_Pa") == relative(expected / 3).epsilon(1e-9));
  CHECK(table.number("deviator_Pa") == relative(expected).epsilon(1e-9));
}

TEST_CASE("measurements: the stress of a bed at rest is the weight above, and the walls bear the weight") {
  const BedAtRest bed = rest(smooth_box(), 0, 2000);
  CHECK(bed.force_on_walls == relative(-bed.weight).epsilon(0.01));
  for (std::size_t i = 0; i < kSlices; ++i) {
    CAPTURE(i);
    CHECK(bed.stress[i] == relative(bed.expected[i]).epsilon(0.02));
  }
}

TEST_CASE("measurements: the stress of a bed below a piston is the piston's pressure, and the weights above") {
  constexpr double kMass = 1e-3;  // kg
  const std::string peas = replaced(smooth_box(), "[[grain]]\nname = \"die\"\ncount = 2\n", "");
  const std::string piston =
      "[[part]]\nname = \"piston\"\nshape = \"box\"\nsize = [0.03, 0.03, 0.01]\nposition = [0.015, 0.015, 0.6]\n"
      "friction = 1e-6\n[part.drive]\naxis = [0, 0, -1]\npressure = 2000\nmass = 1e-3\ndamping = 2\nfrom = 0.4\n";
  const BedAtRest bed = rest(peas + piston, 2000 + 9.81 * kMass / (kWidth * kWidth), 3000);
  for (std::size_t i = 0; i < kSlices; ++i) {
    CAPTURE(i);
    CHECK(bed.stress[i] == relative(bed.expected[i]).epsilon(0.02));
  }
}

TEST_CASE(
    "measurements: in equilibrium the stress between walls is their force over the area, and its strains those of the walls") {
  constexpr double kTarget = 500;  // Pa, along z
  constexpr double kStart = 0.05;  // m, of the cell along z
  std::string text = replaced(smooth_box(), "[gravity]\nacceleration = [0, 0, -9.81]\n", "");
  text +=
      "[[part]]\nname = \"top\"\nshape = \"plane\"\nposition = [0, 0, 0.05]\naxis = [1, 0, 0]\nangle = 180\n[part.drive]\n"
      "axis = [0, 0, -1]\nstress = 500\ngain = 1e-4\nlargest_speed = 0.2\n"
      "between = [\"x_low\", \"x_high\", \"y_low\", \"y_high\"]\n";
  const Scene scene =
      scene_with("kind = \"stress\"\nbetween = [\"y_high\", \"y_low\", \"x_low\", \"x_high\", \"floor\", \"top\"]\n", text);
  std::vector<Placement> peas;
  peas.reserve(27);
  for (int i = 0; i < 27; ++i) {
    const int row = i / 3 % 3, layer = i / 9;
    peas.push_back(upright(kPea, 0.005 + 0.01 * (i % 3), 0.005 + 0.01 * row, 0.004 + 0.012 * layer + 1e-3 * (i % 2)));
  }
  const World world(scene, peas);
  Stepper stepper(world, scene);
  for (int step = 0; step < 6000; ++step) stepper.step();
  double stress = 0, servo = 0;
  constexpr int kSamples = 50;
  MeasuredTable table;
  for (int sample = 0; sample < kSamples; ++sample) {
    stepper.step(true);
    table = measure(scene, world, &stepper);
    stress += table.number("contact_zz_Pa") / kSamples;
    servo += world.walls().servo_stress(scene.walls.size() - 1).value() / kSamples;
  }
  CHECK(servo == relative(kTarget).epsilon(0.01));
  CHECK(stress == relative(servo).epsilon(0.01));
  const double height = world.walls().state(scene.walls.size() - 1).pose.position.z();
  CHECK(height < 0.9 * kStart);
  CHECK(table.number("length_z_m") == relative(height).epsilon(1e-9));
  CHECK(table.number("length_x_m") == relative(kWidth).epsilon(1e-9));
  CHECK(table.number("strain_z") == relative(std::log(kStart / height)).epsilon(1e-9));
  CHECK(std::abs(table.number("strain_x")) < 1e-12);
  CHECK(table.number("volumetric_strain") == relative(table.number("strain_z")).epsilon(1e-9));
  CHECK(table.number("volume_fraction") ==
        relative(27 * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3) / (kWidth * kWidth * height)).epsilon(1e-9));
}

TEST_CASE("measurements: a box between walls needs three pairs across the axes, and no other corners") {
  const auto says = [](const std::string& keys) {
    return complaint(std::string(kSceneText) + "[[measurement]]\nkind = \"stress\"\ninterval = 0.01\n" + keys);
  };
  const std::string four = R"("x_low", "x_high", "y_low", "y_high")";
  check_says(says("between = [" + four + "]\n"), {"measurement.between has 4 walls", "3 pairs"});
  check_says(says("between = [" + four + ", \"floor\", \"x_low\"]\n"),
             {"measurement.between[5] is the string \"x_low\"", "different words"});
  check_says(says("between = [" + four + "]\nlower = [0, 0, 0]\n"), {"measurement.lower is given besides between"});
}

namespace {

constexpr const char* kBetweenAll =
    "kind = \"stress\"\nbetween = [\"x_low\", \"x_high\", \"y_low\", \"y_high\", \"floor\", \"top\"]\n";

/// A box with a lid that has these keys.
std::string box_with_lid(const std::string& keys) {
  return std::string(kSceneText) +
         "[[part]]\nname = \"top\"\nshape = \"plane\"\nposition = [0, 0, 1]\naxis = [1, 0, 0]\nangle = 180\n" + keys;
}

}  // namespace

TEST_CASE("measurements: the walls of a box between walls may rotate about their normals only") {
  const std::string rotation = "[[part.motion]]\nkind = \"rotation\"\nrpm = 1\npoint = [0, 0, 1]\n";
  const std::string torque = "[part.drive]\ntorque = 1\nmoment = 1\npoint = [0, 0, 1]\n";
  const std::string measurement = std::string("[[measurement]]\ninterval = 0.01\n") + kBetweenAll;
  for (const std::string& keys : {rotation, torque}) {
    CHECK(complaint(box_with_lid(keys + "axis = [0, 0, -1]\n").append(measurement)).empty());
    check_says(complaint(box_with_lid(keys + "axis = [1, 0, 1]\n").append(measurement)),
               {"measurement.between has \"top\", which rotates"});
  }
}

TEST_CASE("measurements: there is no box between walls that have rotated together") {
  Scene scene = scene_with(kBetweenAll, box_with_lid(""));
  CHECK(measure(scene, World(scene, column())).number("length_z_m") == 1);
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitZ()));
  for (Wall& wall : scene.walls) wall.start = {quarter * wall.start.position, quarter * wall.start.rotation};
  CHECK_THROWS_WITH_AS(measure(scene, World(scene, column())), doctest::Contains("have rotated"), std::runtime_error);
}

TEST_CASE("measurements: the names of walls are those of their geoms") {
  using Plane = std::array<double, 4>;
  const Scene box = falling_particles::scene_of(kSceneText);
  const World in_box(box, {});
  CHECK(plane_of(in_box, "floor") == Plane{0, 0, 1, 0});
  CHECK(plane_of(in_box, "x_low") == Plane{1, 0, 0, 0});
  CHECK(plane_of(in_box, "x_high") == Plane{-1, 0, 0, -0.05});
  CHECK(plane_of(in_box, "y_low") == Plane{0, 1, 0, 0});
  CHECK(plane_of(in_box, "y_high") == Plane{0, -1, 0, -0.06});

  const Scene terrain = falling_particles::scene_of(scene_in(kTerrainText));
  const World on_terrain(terrain, {});
  const dGeomID ground = on_terrain.walls().geoms().back();
  CHECK(on_terrain.walls().wall_of(ground)->name == "ground");
  CHECK(dGeomGetClass(ground) == dHeightfieldClass);
  CHECK(plane_of(on_terrain, "y_high") == Plane{0, -1, 0, -0.06});
}

TEST_CASE("measurements: a pea on the lid of a hopper weighs on it, and later on the floor") {
  const std::string text = scene_in(kHopperText);
  const Scene on_lid = scene_with("kind = \"part_force\"\nsurfaces = [\"lid\"]\n", text);
  const Scene on_floor = scene_with("kind = \"part_force\"\nsurfaces = [\"floor\"]\n", text);
  const Scene on_mesh = scene_with("kind = \"part_force\"\nsurfaces = [\"hopper\"]\n", text);
  World world(on_lid, {upright(kPea, 0, 0, 0.05 + 3e-3)});
  const double weight = world.grains()[0].mass.mass * 9.81;
  Stepper stepper(world, on_lid);
  for (int step = 0; step < 400; ++step) stepper.step(true);
  CHECK(measure(on_lid, world, &stepper).number("force_z_N") == relative(-weight).epsilon(1e-3));
  CHECK(measure(on_floor, world, &stepper).number("force_z_N") == 0);
  CHECK(measure(on_mesh, world, &stepper).number("force_z_N") == 0);
  const std::unique_ptr<Measurement> floor = on_floor.measurements.front().make(world);  // a run makes them before the lid goes
  world.open_outlet();
  for (int step = 0; step < 1000; ++step) stepper.step(true);
  TableText table;
  floor->measure({0, world, gather_contacts(stepper.measured_contacts(), world, on_lid.time.step)}, table);
  CHECK(std::stod(split(table.text())[4]) == relative(-weight).epsilon(1e-3));
}

TEST_CASE("measurements: a pea on a part that rises weighs on it") {
  const std::string plate = R"(
[[part]]
name = "plate"
shape = "box"
size = [0.03, 0.03, 0.004]
position = [0.02, 0.02, 0.008]
[[part.motion]]
kind = "velocity"
velocity = [0, 0, 0.01]
)";
  const Scene scene = scene_with("kind = \"part_force\"\nsurfaces = [\"plate\"]\nabout = [0.015, 0.02, 0]\n", kSceneText + plate);
  World world(scene, {upright(kPea, 0.02, 0.02, 0.01 + 3e-3)});
  const double weight = world.grains()[0].mass.mass * 9.81;
  Stepper stepper(world, scene);
  for (int step = 0; step < 400; ++step) stepper.step(true);
  CHECK(world.grains()[0].position()[2] == relative(0.012 + 3e-3).epsilon(1e-2));
  const MeasuredTable table = measure(scene, world, &stepper);
  CHECK(table.number("force_z_N") == relative(-weight).epsilon(1e-3));
  CHECK(table.number("torque_y_Nm") == relative(5e-3 * weight).epsilon(1e-2));
}
