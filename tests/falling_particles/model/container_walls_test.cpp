// Tests of the walls of containers: where they are, how they move, and the errors of mistakes.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "model/container.hpp"
#include "observe/simulation.hpp"
#include "run/changes.hpp"
#include "run/stepwise_run.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

constexpr const char* kDrum = R"(kind = "drum"
diameter = 0.1
length = 0.05
segments = 48
rpm = 30)";

constexpr const char* kCell = R"(kind = "cell"
width = [0.05, 0.06]
height = 0.1
x_low.drive = { stress = 1000, gain = 1e-4, largest_speed = 0.2, area = 0.007 }
x_high.drive = { stress = 1000, gain = 1e-4, largest_speed = 0.2 }
y_high.friction = 0.2
y_high.motion = [{ kind = "velocity", velocity = [0, -0.1, 0] }]
z_high.drive = { force = 0.5, mass = 0.1 })";

const Wall& find(const std::vector<Wall>& walls, const std::string& name) {
  const auto found = std::ranges::find(walls, name, &Wall::name);
  REQUIRE(found != walls.end());
  return *found;
}

std::vector<std::string> names_of(const std::vector<Wall>& walls) {
  std::vector<std::string> names;
  std::ranges::transform(walls, std::back_inserter(names), &Wall::name);
  return names;
}

/// The normal of a plane, and its distance from the origin.
std::array<double, 4> plane_of(const Wall& wall) {
  const Vector3 normal = wall.start.rotation * std::get<PlaneShape>(wall.shape).normal;
  return {normal.x(), normal.y(), normal.z(), normal.dot(wall.start.position)};
}

}  // namespace

TEST_CASE("a box is a list of five planes") {
  using Names = std::vector<std::string>;
  using Plane = std::array<double, 4>;
  const std::vector<Wall> walls = walls_in(Box{{0.2, 0.3}});
  CHECK(names_of(walls) == Names{"floor", "x_low", "x_high", "y_low", "y_high"});
  CHECK(plane_of(walls[0]) == Plane{0, 0, 1, 0});
  CHECK(plane_of(walls[1]) == Plane{1, 0, 0, 0});
  CHECK(plane_of(walls[2]) == Plane{-1, 0, 0, -0.2});
  CHECK(plane_of(walls[3]) == Plane{0, 1, 0, 0});
  CHECK(plane_of(walls[4]) == Plane{0, -1, 0, -0.3});
  for (const Wall& wall : walls) CHECK(wall.role == WallRole::Side);
}

TEST_CASE("a hopper is a list of walls, and its lid can be removed") {
  using Names = std::vector<std::string>;
  const Scene scene = scene_of(scene_in(std::string(kHopperText) + "\ndish = { diameter = 0.05, height = 0.01, rim = 0.002 }"));
  CHECK(names_of(scene.walls) == Names{"floor", "x_low", "x_high", "y_low", "y_high", "lid", "hopper", "dish"});
  for (const Wall& wall : scene.walls) CHECK(wall.role == (wall.name == "lid" ? WallRole::Lid : WallRole::Side));
  CHECK(plane_of(find(scene.walls, "lid")) == std::array{0.0, 0.0, 1.0, 0.05});
  CHECK(plane_of(find(scene.walls, "x_high")) == std::array{-1.0, 0.0, 0.0, -0.075});
  World world(scene, {});
  const std::vector<dGeomID> before = world.walls().geoms();
  REQUIRE(before.size() == 8);
  CHECK(world.walls().has_lid());
  world.open_outlet();
  CHECK_FALSE(world.walls().has_lid());
  REQUIRE(world.walls().geoms().size() == 7);
  CHECK(world.walls().wall_of(before[5]) == &scene.walls[5]);  // contacts of the last step may have it
  CHECK(grain_of(before[5]) == nullptr);
  CHECK(world.walls().wall_of(before[6]) == &scene.walls[6]);
  CHECK(world.walls().geoms()[5] == before[6]);
}

TEST_CASE("a terrain is a list of four planes and a ground with the terrain's samples") {
  using Names = std::vector<std::string>;
  const Terrain terrain({{0.2, 0.1}, 0.01, 0.08, 0.005, 5, 7});
  const std::vector<Wall> walls = walls_in(terrain);
  CHECK(names_of(walls) == Names{"x_low", "x_high", "y_low", "y_high", "ground"});
  const auto& ground = std::get<GroundShape>(walls.back().shape);
  CHECK(walls.back().start.position == Vector3(0.1, 0.05, 0));
  REQUIRE(ground.samples == 7);
  CHECK(ground.heights[2 * ground.samples + 3] == terrain.sample(3, 2));
}

TEST_CASE("the sides of a box come before its parts, and are none of them") {
  const Scene scene = scene_of(std::string(kSceneText) + "[[part]]\nname = \"plate\"\nshape = \"plane\"\n");
  REQUIRE(scene.walls.size() == 6);
  REQUIRE(scene.parts().size() == 1);
  CHECK(&scene.parts()[0] == &scene.walls.back());
  CHECK(scene_of(scene_in(kDrum)).parts().size() == 3);
}

TEST_CASE("the shell of a drum is around its axis, at its radius, and looks inwards; the ends look at one another") {
  const Scene scene = scene_of(scene_in(kDrum));
  const Wall& shell = find(scene.walls, "drum");
  const auto& mesh = std::get<MeshShape>(shell.shape);
  const auto corner = [&](unsigned int index) -> Vector3 {
    const auto& [x, y, z] = mesh.vertices[index];
    return shell.start(Vector3(x, y, z));
  };
  const Vector3 middle(0, 0.025, 0.05);
  CHECK(mesh.triangles.size() == 2 * 48);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3 normal = (corner(b) - corner(a)).cross(corner(c) - corner(a)).normalized();
    CHECK(normal.dot(middle - corner(a)) == relative(0.05).epsilon(1e-5));
  }
  CHECK((find(scene.walls, "near_end").start.rotation * Vector3::UnitZ() - Vector3::UnitY()).norm() < 1e-15);
  CHECK((find(scene.walls, "far_end").start.rotation * Vector3::UnitZ() + Vector3::UnitY()).norm() < 1e-15);
  CHECK(contains(scene.container, {0, 0.01, 0.001}));
  CHECK_FALSE(contains(scene.container, {0.04, 0.01, 0.001}));
  CHECK_FALSE(contains(scene.container, {0, 0.06, 0.05}));
}

TEST_CASE("grains in a drum that turns stay in it") {
  const Scene scene = scene_of(Drum{0.08, 0.04, 32, 60, 0.1}, {{lentil(), 60}});
  Simulation simulation(scene, 1);
  const World& world = simulation.world;
  for (int step = 1; step <= 2200; ++step) simulation.advance(step * scene.time.step);
  CHECK(simulation.watches.leaks.count() == 0);
  // It has turned once since 0.1 s.
  const WallState state = world.walls().state(0);
  CHECK((state.pose.rotation * Vector3::UnitX() - Vector3::UnitX()).norm() < 1e-12);
  // A positive speed moves the floor towards -x: the bed leans on that side.
  double x = 0;
  for (const Grain& grain : world.grains()) x += grain.position()[0] / static_cast<double>(world.grains().size());
  CHECK(x < -0.008);
}

TEST_CASE("the sides of a cell are planes around the start, which may stand, move, press and be servos between the others") {
  const Scene scene = scene_of(scene_in(kCell));
  CHECK(names_of(scene.walls) == std::vector<std::string>{"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"});
  CHECK(scene.parts().size() == 6);
  CHECK(plane_of(scene.walls[0]) == std::array<double, 4>{1, 0, 0, 0});
  CHECK(plane_of(scene.walls[1]) == std::array<double, 4>{-1, 0, 0, -0.05});
  CHECK(plane_of(scene.walls[2]) == std::array<double, 4>{0, 1, 0, 0});
  CHECK(plane_of(scene.walls[3]) == std::array<double, 4>{0, -1, 0, -0.06});
  CHECK(plane_of(scene.walls[4]) == std::array<double, 4>{0, 0, 1, 0});
  CHECK(plane_of(scene.walls[5]) == std::array<double, 4>{0, 0, -1, -0.1});
  CHECK(scene.walls[0].drive->servo->area == 0.007);
  CHECK(scene.walls[0].drive->axis == Vector3(1, 0, 0));
  CHECK(scene.walls[1].drive->servo->between == std::vector<FacingWalls>{{"y_low", "y_high"}, {"z_low", "z_high"}});
  CHECK(scene.walls[1].drive->axis == Vector3(-1, 0, 0));
  CHECK_FALSE(scene.walls[2].moves());
  CHECK(scene.walls[3].friction == 0.2);
  CHECK(std::get<Translation>(scene.walls[3].motions.at(0).kind).velocity == Vector3(0, -0.1, 0));
  CHECK(scene.walls[5].drive->force == 0.5);
  CHECK(scene.walls[5].drive->axis == Vector3(0, 0, -1));

  const Scene elsewhere = scene_of(scene_in(replaced(kCell, "width", "corner = [-0.01, 0.02, 0.3]\nwidth")));
  CHECK(plane_of(elsewhere.walls[0]) == std::array<double, 4>{1, 0, 0, -0.01});
  CHECK(plane_of(elsewhere.walls[3])[3] == doctest::Approx(-0.08));
  CHECK(plane_of(elsewhere.walls[4]) == std::array<double, 4>{0, 0, 1, 0.3});
  CHECK(plane_of(elsewhere.walls[5])[3] == doctest::Approx(-0.4));
  Random random(1);
  for (const Placement& grain : place(elsewhere, random)) {
    CHECK(Region{{-0.01, 0.02, 0.3}, {0.05, 0.06, 0.1}}.contains(grain.position));
  }

  const std::string lidless = "kind = \"cell\"\nwidth = [0.05, 0.06]\n";
  const Scene open = scene_of(scene_in(lidless + "z_low.drive = { stress = 1000, gain = 1e-4, largest_speed = 0.2 }"));
  CHECK(names_of(open.walls) == std::vector<std::string>{"x_low", "x_high", "y_low", "y_high", "z_low"});
  CHECK(open.walls[4].drive->servo->between == std::vector<FacingWalls>{{"x_low", "x_high"}, {"y_low", "y_high"}});
  const std::string plate =
      "[[part]]\nname = \"plate\"\nshape = \"plane\"\nposition = [0, 0, 0.3]\naxis = [1, 0, 0]\nangle = 180\n";
  const Scene other = scene_of(scene_in(lidless + "x_high.drive = { stress = 1e3, gain = 1e-4, largest_speed = 0.2, "
                                                  "between = [\"y_low\", \"y_high\", \"z_low\", \"plate\"] }") +
                               plate);
  CHECK(other.walls[1].drive->servo->between == std::vector<FacingWalls>{{"y_low", "y_high"}, {"z_low", "plate"}});
}

TEST_CASE("a cell that has no room for its grains is named by its height, and a side by its own keys") {
  const std::string cell = "kind = \"cell\"\nwidth = [0.05, 0.06]\nheight = 0.013\n";
  check_says(complaint(scene_in(cell)), {"container.height is 0.013 m, with room for ", " of the scene's 7 grains at the start"});
  check_says(complaint(scene_in(replaced(cell, "height = 0.013", "height = 0.1") +
                                "x_low.drive = { stress = 1e3, gain = 1e-4, largest_speed = 0.2, between = [\"x_low\"] }")),
             {"container.x_low.drive.between has 1 wall; allowed: 2 pairs"});
  check_says(complaint(replaced(scene_in(replaced(kCell, "y_high.friction", "y_high.restitution")),
                                "[max_correcting_velocity]\nvelocity = 0.05\n", "[compliance]\nstiffness = 1e4\n")),
             {"container.y_high.restitution besides an effect of the scene", "allowed: a wall without it"});
  check_says(complaint(scene_in(kCell) + "[[part]]\nname = \"x_low\"\nshape = \"plane\"\n"),
             {"part.name is \"x_low\", which a wall of the container has"});
}

TEST_CASE("two servos of a cell press a grain between them with their stress times the area between the other sides") {
  const std::string servo = ".drive = { stress = 10, gain = 0.02, largest_speed = 0.2 }\n";
  Scene scene =
      scene_of(replaced(scene_in("kind = \"cell\"\nwidth = [0.05, 0.06]\nheight = 0.07\nx_low" + servo + "x_high" + servo),
                        "[0, 0, -9.81]", "[0, 0, 0]"));
  scene.start = StartState{.overlap = 0.1, .grains = {{.position = {0.02, 0.03, 0.03}}}};
  Simulation simulation(scene, 1);
  const WallBodies& walls = simulation.world.walls();
  for (int i = 0; i < 800; ++i) simulation.stepper.step();
  CHECK(walls.driven(0)->push == relative(10 * 0.06 * 0.07).epsilon(1e-12));
  for (const std::size_t side : {0U, 1U}) CHECK(*walls.servo_stress(side) == relative(10).epsilon(1e-3));
  const double width = walls.state(1).pose.position.x() - walls.state(0).pose.position.x();
  CHECK(width == relative(2 * 3e-3).epsilon(0.01));
  CHECK(walls.state(0).pose.position.x() > 0.01);
}

TEST_CASE("the stress and the motion of a side of a cell change during a run, and its friction does not") {
  const std::string text = scene_in(kCell);
  Scene scene = scene_of(text);
  StepwiseRun run(scene, 1, std::nullopt);
  run.advance(1, nullptr);
  const auto change = [&](const std::string& assignment) {
    change_values(run, scene, {assignment}, [&] { return scene_of(text, {assignment}); });
  };
  change("container.x_high.drive.stress=20");
  change("container.y_high.motion=[{ kind = \"velocity\", velocity = [0, -0.2, 0] }]");
  CHECK(scene.walls[1].drive->servo->stress == 20);
  CHECK(std::get<Translation>(scene.walls[3].motions.at(0).kind).velocity == Vector3(0, -0.2, 0));
  check_says(refusal_by([&] { change("container.y_high.friction=0.3"); }),
             {"container.y_high.friction is fixed during a run", "container.SIDE.motion", "container.SIDE.drive.stress"});
}

TEST_CASE("the error of a moving container names the key, its value and the allowed values") {
  struct Wrong {
    const char* container;
    Mistake mistake;
  };
  const std::vector<Wrong> all = {
      {kDrum, {"rpm = 30", "rpm = 1e9", {"container.rpm is 1e+09", "revolutions a minute"}}},
      {kDrum, {"segments = 48", "segments = 48\nturns_at = 1", {"container.turns_at is 1", "before time.duration"}}},
      {kDrum, {"diameter = 0.1", "diameter = 0.03", {"container.diameter is 0.03 m, with room for 0 of the scene's 7 grains"}}},
      {kDrum, {"length = 0.05", "length = 0.01", {"container.length is 0.01", "fits in any orientation"}}},
      {kCell,
       {"stress = 1000, gain = 1e-4, largest_speed = 0.2 }",
        "stress = -1, gain = 1, largest_speed = 1 }",
        {"container.x_high.drive.stress is -1", "(0, 1e+09] Pa"}}},
      {kCell, {"height = 0.1\n", "", {"container.z_high", "without container.height"}}},
      {kCell, {"z_high.drive = { force", "z_hig.drive = { force", {"unknown key \"z_hig\"", "did you mean \"z_high\""}}},
      {kCell, {"force = 0.5, mass", "force = 0.5, stress = 1, mass", {"container.z_high.drive has both force and stress"}}},
      {kCell, {"y_high.friction = 0.2", "y_high.shape = \"box\"", {"unknown key \"shape\"", "container.y_high"}}},
      {"kind = \"cell\"\nwidth = [0.05, 0.06]\nx_low.drive = { stress = 1, gain = 1, largest_speed = 1 }",
       {"gain = 1,", "gain = 2,", {"container.x_low.drive.area is missing", "m^2"}}},
  };
  for (const Wrong& wrong : all) {
    const Mistake& mistake = wrong.mistake;
    CAPTURE(std::string(mistake.to));
    check_says(complaint(replaced(scene_in(wrong.container), mistake.from, mistake.to)), mistake.says);
  }
}

TEST_CASE("the sample scenes with parts are valid, and their grains start within the container") {
  for (const char* name : {"drum", "tray", "shear_cell", "conveyor", "piston", "cell"}) {
    CAPTURE(name);
    const Scene scene = load_scene(SUPERNORMAL_SAMPLES "/scenes/" + std::string(name) + ".toml");
    Simulation simulation(scene, 1);
    CHECK_FALSE(scene.parts().empty());
    for (int i = 0; i < 20; ++i) simulation.stepper.step();
    for (const Grain& grain : simulation.world.grains()) CHECK(contains(scene.container, grain.position()));
  }
}
