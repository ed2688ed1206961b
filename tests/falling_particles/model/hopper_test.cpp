#include "model/hopper.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "common/random.hpp"
#include "observe/discharge.hpp"
#include "observe/simulation.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/world.hpp"

using namespace falling_particles;

namespace {

constexpr Hopper kHopper{.outlet = 0.036,
                         .wall_angle = 30,
                         .diameter = 0.072,
                         .cylinder_height = 0.1,
                         .segments = 48,
                         .clearance = 0.06,
                         .tray_width = 0.12,
                         .opens_at = 0.3};
GrainKind soybean() { return {"soybean", {3.275e-3, 2.78e-3, 2.265e-3}, 2, 2, 0, 1250, "test"}; }

}  // namespace

TEST_CASE("the hopper's mesh is open at the outlet and the top only, and wound the same way everywhere") {
  for (const int segments : {3, 8, 48}) {
    CAPTURE(segments);
    Hopper hopper = kHopper;
    hopper.segments = segments;
    const Mesh mesh = make_mesh(hopper);
    std::map<std::pair<unsigned int, unsigned int>, int> edges;  // directed
    for (const auto& triangle : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) ++edges[{triangle[k], triangle[(k + 1) % 3]}];
    }
    int at_outlet = 0;
    int at_top = 0;
    for (const auto& [edge, count] : edges) {
      CHECK(count == 1);
      if (edges.contains({edge.second, edge.first})) continue;
      const double z1 = mesh.vertices[edge.first][2];
      const double z2 = mesh.vertices[edge.second][2];
      CHECK(z1 == z2);
      if (z1 == static_cast<float>(hopper.clearance)) ++at_outlet;
      if (z1 == static_cast<float>(hopper.top())) ++at_top;
    }
    CHECK(at_outlet == segments);
    CHECK(at_top == segments);
  }
}

TEST_CASE("ODE hits the mesh where the hopper ends, from inside") {
  const Scene scene = scene_of(kHopper, {{soybean(), 1}});
  const World world(scene, {{0, {0, 0, 0.2}, {1, 0, 0, 0}}});
  dGeomID mesh = nullptr;
  for (dGeomID geom : world.walls().geoms()) {
    if (dGeomGetClass(geom) == dTriMeshClass) mesh = geom;
  }
  REQUIRE(mesh != nullptr);
  dGeomID ray = dCreateRay(nullptr, 1);
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const double z = std::lerp(kHopper.clearance + 1e-4, kHopper.top() - 1e-4, random.uniform());
    const double angle = 2 * std::numbers::pi * random.uniform();
    CAPTURE(z);
    CAPTURE(angle);
    dGeomRaySet(ray, 0, 0, z, std::cos(angle), std::sin(angle), 0);
    dGeomRaySetClosestHit(ray, 1);
    dContactGeom hit;
    REQUIRE(dCollide(ray, mesh, 1, &hit, sizeof hit) == 1);
    CHECK(hit.normal[0] * std::cos(angle) + hit.normal[1] * std::sin(angle) < 0);
    const double distance = std::hypot(hit.pos[0], hit.pos[1]);
    const Point before{(distance - 1e-6) * std::cos(angle), (distance - 1e-6) * std::sin(angle), z};
    const Point behind{(distance + 1e-6) * std::cos(angle), (distance + 1e-6) * std::sin(angle), z};
    CHECK(kHopper.contains(before));
    CHECK_FALSE(kHopper.contains(behind));
  }
  dGeomDestroy(ray);
}

TEST_CASE("a point in a hopper or its tray is inside") {
  const double middle = kHopper.clearance + kHopper.cone_height() / 2;  // the radius is 0.027 there
  CHECK(kHopper.contains({0.0269, 0, middle}));
  CHECK_FALSE(kHopper.contains({0.0271, 0, middle}));
  CHECK(kHopper.contains({0.0359, 0, kHopper.top()}));
  CHECK(kHopper.contains({0.0359, 0, kHopper.top() + 1}));
  CHECK_FALSE(kHopper.contains({0.0361, 0, kHopper.top() + 1}));
  CHECK(kHopper.contains({0, 0, kHopper.clearance}));
  CHECK(kHopper.contains({0.0599, -0.0599, 1e-6}));
  CHECK_FALSE(kHopper.contains({0.0601, 0, 0.01}));
  CHECK_FALSE(kHopper.contains({0, 0, -1e-6}));
  CHECK_FALSE(kHopper.contains({0, 0, INFINITY}));
  CHECK_FALSE(kHopper.contains({NAN, 0, 0.01}));
  CHECK_FALSE(kHopper.contains({0, NAN, 0.1}));
  CHECK_FALSE(kHopper.contains({0, 0, NAN}));
}

TEST_CASE("the mean height of a level filling") {
  // In a frustum of radii r and R it is h (r^2 + 2 r R + 3 R^2) / (4 (r^2 + r R + R^2)) above the smaller end.
  const double r = 0.018;
  const double rr = 0.036;
  const double h = kHopper.cone_height();
  CHECK(h == supernormal::test::relative(0.018 * std::sqrt(3)).epsilon(1e-14));
  const double cone_volume = h / 3 * (r * r + r * rr + rr * rr);
  const double cone_mean = h * (r * r + 2 * r * rr + 3 * rr * rr) / (4 * (r * r + r * rr + rr * rr));
  CHECK(kHopper.mean_height(kHopper.clearance + h) == supernormal::test::relative(cone_mean).epsilon(1e-13));
  const double cylinder_volume = rr * rr * 0.04;
  const double both = (cone_volume * cone_mean + cylinder_volume * (h + 0.02)) / (cone_volume + cylinder_volume);
  CHECK(kHopper.mean_height(kHopper.clearance + h + 0.04) == supernormal::test::relative(both).epsilon(1e-13));
  CHECK(kHopper.mean_height(kHopper.clearance + 1e-6) == supernormal::test::relative(0.5e-6).epsilon(1e-3));
}

TEST_CASE("Beverloo's law") {
  // The number by hand: 0.58 * 750 * sqrt(9.81) * (0.036 - 1.4 * 0.005)^2.5 = 0.58 * 750 * 3.13209 * 0.029^2.5.
  CHECK(beverloo_mass_flow(0.036, 0.005, 750, 9.81) == supernormal::test::relative(0.195124).epsilon(1e-3));
  CHECK(beverloo_mass_flow(0.007, 0.005, 750, 9.81) == doctest::Approx(0).epsilon(1e-12));
  CHECK(beverloo_mass_flow(0.003, 0.005, 750, 9.81) == 0);
}

TEST_CASE("a grain that passes the outlet counts once; a grain beside the outlet does not count") {
  const Scene scene = scene_of(kHopper, {{lentil(), 5}});
  World world(scene, {{0, {0, 0, 0.07}, {1, 0, 0, 0}},
                      {0, {0.01, 0, 0.07}, {1, 0, 0, 0}},
                      {0, {-0.01, 0, 0.07}, {1, 0, 0, 0}},
                      {0, {0, 0.01, 0.07}, {1, 0, 0, 0}},
                      {0, {0, -0.01, 0.07}, {1, 0, 0, 0}}});
  Random random(1);
  Discharge discharge(world, kHopper, random);
  const double grain_mass = world.grains()[0].mass.mass;
  const auto drop = [&](std::size_t i, double x) { dBodySetPosition(world.grains()[i].body, x, 0, 0.0599); };
  const std::size_t walls = world.walls().geoms().size();
  drop(0, 0);
  discharge.after_step(0.2);
  CHECK_FALSE(discharge.charge());
  CHECK(discharge.count() == 0);
  CHECK(world.walls().geoms().size() == walls);
  dBodySetPosition(world.grains()[0].body, 0, 0, 0.07);
  discharge.after_step(0.3);
  REQUIRE(discharge.charge());
  CHECK(discharge.charge()->time == 0.3);
  CHECK(discharge.charge()->mass == supernormal::test::relative(5 * grain_mass));
  CHECK(discharge.charge()->grain_diameter ==
        supernormal::test::relative(2 * std::cbrt(3.36e-3 * 3.36e-3 * 1.29e-3)).epsilon(1e-9));
  CHECK(world.walls().geoms().size() == walls - 1);
  drop(0, 0);
  drop(1, 0.03);  // beside the outlet
  discharge.after_step(0.4);
  discharge.after_step(0.5);
  CHECK(discharge.count() == 1);
  CHECK_FALSE(discharge.mass_flow());
  drop(2, -0.005);
  discharge.after_step(0.6);
  drop(3, 0.002);
  discharge.after_step(0.8);
  CHECK(discharge.count() == 3);
  CHECK(discharge.mass() == supernormal::test::relative(3 * grain_mass));
  CHECK(discharge.last_passage() == 0.8);
  // 20 % of the charge is reached with the first grain at 0.4 s, 60 % with the third at 0.8 s.
  REQUIRE(discharge.mass_flow());
  CHECK(*discharge.mass_flow() == supernormal::test::relative(2 * grain_mass / 0.4));
}

TEST_CASE(
    "an outlet that is open from the start has no lid, and grains below it belong neither to the charge nor to the discharge") {
  Hopper hopper = kHopper;
  hopper.opens_at = 0;
  const Scene scene = scene_of(hopper, {{lentil(), 3}});
  CHECK(std::ranges::none_of(scene.walls, [](const Wall& wall) { return wall.role == WallRole::Lid; }));
  World world(scene, {{0, {0, 0, 0.07}, {1, 0, 0, 0}}, {0, {0, 0, 0.03}, {1, 0, 0, 0}}, {0, {0.04, 0, 0.01}, {1, 0, 0, 0}}});
  Random random(1);
  Discharge discharge(world, hopper, random);
  const double grain_mass = world.grains()[0].mass.mass;
  discharge.after_step(5e-4);
  REQUIRE(discharge.charge());
  CHECK(discharge.charge()->mass == supernormal::test::relative(grain_mass).epsilon(1e-12));
  CHECK(discharge.charge()->bed.height < 2.1 * (0.07 - hopper.clearance));
  dBodySetPosition(world.grains()[2].body, 0, 0, 0.01);  // rolls below the outlet
  discharge.after_step(1e-3);
  CHECK(discharge.count() == 0);
  dBodySetPosition(world.grains()[0].body, 0, 0, 0.05);
  discharge.after_step(1.5e-3);
  CHECK(discharge.count() == 1);
}

TEST_CASE("the bed in a hopper: one lying column of known volume") {
  // The grains are nearly boxes, side by side from wall to wall: 0.6 of the section's square.
  Hopper hopper = kHopper;
  hopper.outlet = 0.0719;  // the cone is a rim
  hopper.wall_angle = 80;
  const GrainKind box{"box", {0.01, 0.01, 0.02}, 200, 200, 0, 1000, "test"};
  const Scene scene = scene_of(hopper, {{box, 4}});
  const double z = hopper.clearance + 0.02;
  const World world(scene, {{0, {0.011, 0.011, z}, {1, 0, 0, 0}},
                            {0, {-0.011, 0.011, z}, {1, 0, 0, 0}},
                            {0, {0.011, -0.011, z}, {1, 0, 0, 0}},
                            {0, {-0.011, -0.011, z}, {1, 0, 0, 0}}});
  Random random(1);
  const Bed bed = measure_bed(world, hopper, random);
  CHECK(bed.height == supernormal::test::relative(0.04).epsilon(1e-4));
  const double section = 48 * std::tan(std::numbers::pi / 48) * 0.036 * 0.036;
  const double expected = 4 * 0.02 * 0.02 / section;
  CHECK(std::abs(bed.volume_fraction - expected) < 4 * bed.standard_error + 0.02 * expected);  // edges: exponent 200
  CHECK(bed.bulk_density == supernormal::test::relative(1000 * bed.volume_fraction).epsilon(1e-12));
}

TEST_CASE("grains rest on the lid, flow out when it is removed, and none leaks") {
  const Scene scene = scene_of(kHopper, {{soybean(), 30}});
  Simulation simulation(scene, 1);
  const World& world = simulation.world;
  const Discharge& discharge = *simulation.watches.discharge;
  for (int step = 1; step <= 1600; ++step) {  // to 0.8 s
    simulation.advance(step * scene.time.step);
    if (step == 590) {
      for (const Grain& grain : world.grains()) CHECK(grain.position()[2] > kHopper.clearance);
    }
  }
  CHECK(simulation.watches.leaks.count() == 0);
  CHECK(discharge.count() == 30);
  CHECK(discharge.last_passage() < 0.7);
  REQUIRE(discharge.mass_flow());
  CHECK(*discharge.mass_flow() > 0);
  for (const Grain& grain : world.grains()) CHECK(grain.position()[2] < 0.02);
}
