// The names of walls.
#include "observe/surfaces.hpp"

#include <doctest/doctest.h>

#include <array>

#include "measured.hpp"
#include "support/relative.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

std::array<double, 4> plane_of(const World& world, const std::string& name) {
  const std::vector<NamedSurface> surfaces = surfaces_of(world);
  const auto found = std::ranges::find(surfaces, name, &NamedSurface::name);
  REQUIRE(found != surfaces.end());
  REQUIRE(dGeomGetClass(found->geom) == dPlaneClass);
  dVector4 plane;
  dGeomPlaneGetParams(found->geom, plane);
  return {plane[0], plane[1], plane[2], plane[3]};
}

}  // namespace

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
  const std::vector<NamedSurface> of_terrain = surfaces_of(on_terrain);
  CHECK(of_terrain.back().name == "ground");
  CHECK(dGeomGetClass(of_terrain.back().geom) == dHeightfieldClass);
  CHECK(plane_of(on_terrain, "y_high") == Plane{0, -1, 0, -0.06});
  CHECK(surface_name(of_terrain, nullptr) == "wall");
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
