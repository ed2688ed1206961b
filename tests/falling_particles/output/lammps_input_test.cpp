// Scenes as inputs of LAMMPS.
#include "output/lammps_input.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <variant>

#include "common/input_error.hpp"
#include "common/random.hpp"
#include "model/container.hpp"
#include "model/wall.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"

using falling_particles::Hopper;
using falling_particles::InputError;
using falling_particles::LammpsInput;
using falling_particles::load_scene;
using falling_particles::Mesh;
using falling_particles::Scene;
using supernormal::test::relative;

namespace {

namespace fx = supernormal::effects;

Scene sample_scene(const std::string& name) { return load_scene(std::string(SUPERNORMAL_SAMPLES) + "/scenes/" + name + ".toml"); }

/// The numbers that follow the first place of `word` in a line.
double number_after(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  REQUIRE(at != std::string::npos);
  return std::stod(text.substr(at + word.size()));
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string refusal(const Scene& scene) {
  return refusal_by([&] { lammps_input(scene); });
}

}  // namespace

TEST_CASE("to LAMMPS: a state has its velocities, as angular momenta of LAMMPS") {
  Scene scene = sample_scene("short");
  const falling_particles::StartGrain grain{.kind = 1,
                                            .position = {0.02, 0.02, 0.03},
                                            .quaternion = {0.8, 0, 0.6, 0},
                                            .velocity = {1, 2, 3},
                                            .angular_velocity = {40, 0, 0}};
  CHECK(!has(lammps_input(scene).data, "Velocities"));
  scene.start = falling_particles::StartState{.has_velocities = true, .grains = {grain}};
  const LammpsInput input = lammps_input(scene);
  CHECK(has(input.data, "\n1 atoms\n"));
  std::istringstream line(input.data.substr(input.data.find("Velocities # ellipsoid\n\n") + 24));
  std::array<double, 7> numbers{};
  for (double& number : numbers) line >> number;
  CHECK(numbers[3] == 3);
  // The grain is turned by 2 asin(0.6) about y: its x-axis is (0.28, 0, -0.96), its z-axis (0.96, 0, 0.28).
  const auto& [a, b, c] = scene.kinds[1].kind.half_axes;
  const double mass = scene.kinds[1].kind.density * 4 / 3 * std::numbers::pi * a * b * c;  // soybeans are ellipsoids
  const double along_x = mass / 5 * (b * b + c * c) * 40 * 0.28, along_z = mass / 5 * (a * a + b * b) * 40 * 0.96;
  CHECK(numbers[4] == relative(0.28 * along_x + 0.96 * along_z).epsilon(1e-12));
  CHECK(std::abs(numbers[5]) < 1e-12 * numbers[4]);
  CHECK(numbers[6] == relative(-0.96 * along_x + 0.28 * along_z).epsilon(1e-9));
}

TEST_CASE("to LAMMPS: a box of grains has the masses of the scene, and springs that overlap by a hundredth") {
  const Scene scene = sample_scene("short");
  const LammpsInput input = lammps_input(scene);
  CHECK(has(input.commands, "wall/supernormal box 0 0 0 0.05 0.05"));
  CHECK(has(input.commands, "gravity 9.81 vector 0 0 -9.81"));
  CHECK(has(input.commands, " friction 0.4"));
  CHECK(has(input.commands, "pair_coeff 3 3 exponents 2 2.8  # tablet_biconvex"));

  // LAMMPS computes the mass from the volume of the ellipsoid.
  std::istringstream data(input.data.substr(input.data.find("ellipsoid\n\n", input.data.find("Atoms")) + 11));
  double lightest = INFINITY, heaviest = 0, top = 0;
  for (int i = 0; i < scene.grains_at_start(); ++i) {
    int id = 0, type = 0, is_ellipsoid = 0;
    double density = 0, x = 0, y = 0, z = 0;
    data >> id >> type >> is_ellipsoid >> density >> x >> y >> z;
    REQUIRE(id == i + 1);
    const auto& axes = scene.kinds.at(static_cast<std::size_t>(type - 1)).kind.half_axes;
    const double mass = density * 4 / 3 * std::numbers::pi * axes[0] * axes[1] * axes[2];
    lightest = std::min(lightest, mass);
    heaviest = std::max(heaviest, mass);
    top = std::max(top, z);
  }
  const double stiffness = number_after(input.commands, "hooke ");
  const double depth = std::sqrt(heaviest * 2 * 9.81 * top / stiffness);
  CHECK(depth == relative(0.01 * scene.smallest_half_axis()).epsilon(1e-6));
  const double step = number_after(input.commands, "timestep ");
  CHECK(step == relative(std::numbers::pi * std::sqrt(lightest / 2 / stiffness) / 50).epsilon(1e-6));
  CHECK(number_after(input.commands, "\nrun ") == relative(scene.time.duration / step).epsilon(1e-5));
}

TEST_CASE("to LAMMPS: a drum rotates from the time of the scene") {
  const LammpsInput input = lammps_input(sample_scene("drum"));
  CHECK(has(input.commands, "cylinder 0 0 0.06 0 1 0 0.06"));
  CHECK(has(input.commands, "move rotate 0 1 0 0 0 0.06 20 from 0.5"));
  CHECK(has(input.commands, "plane 0 0.05 0.06 0 -1 0"));
}

TEST_CASE("to LAMMPS: a hopper and its dish are meshes, and the lid is removed when the outlet opens") {
  const Scene scene = sample_scene("heap");
  const LammpsInput input = lammps_input(scene);
  CHECK(has(input.commands, "fix tray all wall/supernormal box -0.15 -0.15 0 0.15 0.15 1e3 hooke"));
  CHECK(has(input.commands, "fix lid all wall/supernormal plane 0 0 0.085 0 0 1 hooke"));
  CHECK(has(input.commands, "fix dish all wall/supernormal mesh heap.dish.obj 1 hooke"));
  const double step = number_after(input.commands, "timestep ");
  const std::size_t lid = input.commands.find("unfix lid");
  REQUIRE(lid != std::string::npos);
  CHECK(number_after(input.commands.substr(0, lid), "\nrun ") == relative(0.5 / step).epsilon(1e-5));
  CHECK(number_after(input.commands.substr(lid), "\nrun ") == relative(3.5 / step).epsilon(1e-5));
  // Grains fall off the dish into a tray that is wider than the hopper.
  CHECK(number_after(input.data, "types\n\n") < -0.15);

  const Mesh mesh = make_mesh(std::get<Hopper>(scene.container));
  REQUIRE(input.files.size() == 2);
  CHECK(input.files[0].name == "heap.hopper.obj");
  const std::string& text = input.files[0].text;
  CHECK(static_cast<std::size_t>(std::ranges::count(text, 'v')) == mesh.vertices.size());
  CHECK(static_cast<std::size_t>(std::ranges::count(text, 'f')) == mesh.triangles.size());
  CHECK(number_after(text, "v ") == relative(mesh.vertices[0][0]).epsilon(1e-7));
  CHECK(number_after(text, "f ") == mesh.triangles[0][0] + 1);
}

TEST_CASE("to LAMMPS: the sides of a cell are planes with their own laws, motions and drives") {
  const LammpsInput input = lammps_input(sample_scene("cell"));
  const std::string law = " hooke 50000 restitution 0.1 friction 1e-06";
  CHECK(has(input.commands, "boundary m m m\n"));
  CHECK(has(input.commands, "pair_coeff * * hooke 50000 restitution 0.1 friction 0.5\n"));
  CHECK(
      has(input.commands, "fix x_low all wall/supernormal plane 0 0 0 1 0 0" + law +
                              " drive axis 1 0 0 stress 10000 gain 0.0001 largest_speed 0.5 between y_low y_high z_low z_high\n"));
  CHECK(has(input.commands, "fix z_low all wall/supernormal plane 0 0 0 0 0 1" + law + "\n"));
  CHECK(has(input.commands, law + " move linear 0 0 -0.02 from 0.2 drive axis 0 0 -1 stress 10000 "));
  CHECK(has(input.commands, " between x_low x_high y_low y_high until 0.2\n"));

  Scene scene = sample_scene("short");
  scene.container = falling_particles::Cell{{{{0, 0, 0}, {0.05, 0.05, 0.1}}, {{-9, -9, -9}, {18, 18, 18}}}};
  scene.walls = walls_in(scene.container);
  scene.walls[0].friction = 0.7;
  scene.effects.emplace_back(
      fx::Friction{0.7, fx::MaterialSelector::between(0, falling_particles::material_of_wall(scene.walls, 0))});
  falling_particles::Drive lid{-falling_particles::Vector3::UnitZ(), 2, 0.5};
  lid.damping = 3;
  lid.travel = {0, 0.02};
  scene.walls[5].drive = lid;
  falling_particles::Drive door{falling_particles::Vector3::UnitZ(), 4, 0.25};
  door.power = 8;
  door.point = falling_particles::Vector3(0.05, 0, 0);
  door.travel = {-std::numbers::pi / 4, std::numbers::pi / 2};
  scene.walls[1].drive = door;
  scene.walls[4].motions = {{falling_particles::Vibration{{0, 0, 1e-3}, 20, 0.5}, 0, 0.1}};
  const std::string commands = lammps_input(scene).commands;
  CHECK(number_after(commands.substr(commands.find("fix x_low")), "friction ") == 0.7);
  CHECK(number_after(commands.substr(commands.find("fix y_low")), "friction ") == 0.4);
  CHECK(has(commands, " drive axis 0 0 -1 force 2 mass 0.5 gravity fall damping 3 travel 0 0.02\n"));
  CHECK(has(commands, " drive axis 0 0 1 power 8 largest_torque 4 point 0.05 0 0 moment 0.25 travel -45 90\n"));
  CHECK(has(commands, " move vibrate 0 0 0.001 20 0.5 until 0.1\n"));
  scene.walls[4].motions = {{falling_particles::Conveyor{{1, 0, 0}, {{0, 0, 1}, {0, 0, 0}, 0}}}};
  CHECK(has(lammps_input(scene).commands, " move conveyor 1 0 0\n"));
  scene.walls[4].motions = {{falling_particles::Conveyor{{0, 0, 0}, {{0, 0, 1}, {0, 0, 0}, 3}}}};
  CHECK(has(refusal(scene), "conveyor with rpm has no counterpart"));
}

TEST_CASE("to LAMMPS: servos that would rattle are named together, with the gain that would do") {
  Scene scene = sample_scene("cell");
  const std::vector<std::string> warnings = lammps_input(scene).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(has(warnings[0], "wall \"x_low\" may rattle in LAMMPS"));
  CHECK(has(warnings[0], R"(the same holds for "x_high", "y_low", "y_high", "z_high")"));
  const double most = number_after(warnings[0], ", and up to ");
  for (falling_particles::Wall& wall : scene.walls) {
    if (wall.drive) wall.drive->servo->gain = 0.99 * most;
  }
  CHECK(lammps_input(scene).warnings.empty());
}

TEST_CASE("to LAMMPS: the springs of a scene are kept") {
  Scene scene = sample_scene("short");
  scene.effects.emplace_back(fx::Hertz{1e8, 0.3, 0.7, {}});
  CHECK(has(lammps_input(scene).commands, "hertz 100000000 0.3 restitution 0.7 friction 0.4"));
  scene.effects.emplace_back(fx::RollingResistance{1e-4, 2e-4, {}});
  scene.effects.emplace_back(fx::Adhesion{0.001, {}});
  CHECK(has(lammps_input(scene).commands, "friction 0.4 rolling 0.0001 spinning 0.0002 adhesion 0.001"));
}

TEST_CASE("to LAMMPS: a setting without a counterpart is refused by name") {
  CHECK(has(refusal(sample_scene("terrain")), "a container of kind terrain has no counterpart"));
  Scene scene = sample_scene("short");
  scene.effects.emplace_back(fx::StokesDrag{});
  CHECK(has(refusal(scene), "stokes_drag has no counterpart"));
  scene = sample_scene("short");
  scene.effects.emplace_back(fx::Restitution{0.5, 0, fx::MaterialSelector::of(1)});
  CHECK(has(refusal(scene), "[restitution] of a material has no counterpart"));
}
