#include "model/terrain.hpp"

#include <doctest/doctest.h>
#include <ode/ode.h>

#include <algorithm>
#include <cmath>

#include "common/random.hpp"
#include "observe/simulation.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/world.hpp"

using namespace falling_particles;

namespace {

constexpr TerrainParameters kParameters{
    .width = {0.12, 0.08}, .amplitude = 0.008, .wavelength = 0.06, .ridge_height = 0.01, .samples = 41, .seed = 4};

GrainKind die() { return {"die", {4e-3, 4e-3, 4e-3}, 8, 8, 1e-3, 1190, "test"}; }

}  // namespace

TEST_CASE("a landscape without ridges is smooth, with the scene's amplitude and wavelength") {
  TerrainParameters parameters = kParameters;
  parameters.ridge_height = 0;
  const Landscape landscape(parameters);
  const double most = 0.008 * (1 + 1.0 / 4 + 1.0 / 16);
  double highest = -1;
  double lowest = 1;
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double x = 10 * random.uniform();
    const double y = 10 * random.uniform();
    const double z = landscape.height(x, y);
    highest = std::max(highest, z);
    lowest = std::min(lowest, z);
    // The steepest slope of a wave is 2 pi amplitude / length; 4^-k over 2^-k is 2^-k.
    const double slope = std::hypot(landscape.height(x + 1e-6, y) - z, landscape.height(x, y + 1e-6) - z) / 1e-6;
    CHECK(slope < 2 * 3.1416 * 0.008 / 0.06 * 1.75 * 1.001);
  }
  CHECK(highest <= most);
  CHECK(highest > 0.9 * most);
  CHECK(lowest >= -most);
  CHECK(lowest < -0.9 * most);
}

TEST_CASE("ridges are parallel and sharp, and a wavelength apart") {
  TerrainParameters parameters = kParameters;
  parameters.amplitude = 0;
  const Landscape landscape(parameters);
  // Along x the crests are wavelength / |cos alpha| apart; along the steepest direction the wavelength.
  double highest = 0;
  std::size_t high = 0;
  constexpr std::size_t kPoints = 100000;
  Random random(2);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double z = landscape.height(20 * random.uniform(), 20 * random.uniform());
    CHECK(z >= 0);
    CHECK(z <= 0.01);
    highest = std::max(highest, z);
    if (z > 0.005) ++high;
  }
  CHECK(highest > 0.0099);
  // Half-way up, the width of a ridge is half of the wavelength / 2 that it covers.
  CHECK(static_cast<double>(high) / kPoints == supernormal::test::relative(0.25).epsilon(0.03));
}

TEST_CASE("the seed determines the landscape") {
  TerrainParameters other = kParameters;
  other.seed = 5;
  CHECK(Landscape(kParameters).height(0.03, 0.05) == Landscape(kParameters).height(0.03, 0.05));
  CHECK(Landscape(kParameters).height(0.03, 0.05) != Landscape(other).height(0.03, 0.05));
}

TEST_CASE("the samples are heights of the landscape, and one cell extends beyond each wall") {
  const Terrain terrain(kParameters);
  const Landscape landscape(kParameters);
  CHECK(terrain.samples_per_side() == 43);
  CHECK(terrain.spacing()[0] == supernormal::test::relative(0.003).epsilon(1e-14));
  CHECK(terrain.spacing()[1] == supernormal::test::relative(0.002).epsilon(1e-14));
  double highest = -1;
  for (std::size_t i = 0; i < 43; ++i) {
    for (std::size_t j = 0; j < 43; ++j) {
      const double x = (static_cast<double>(i) - 1) * 0.003;
      const double y = (static_cast<double>(j) - 1) * 0.002;
      CHECK(std::abs(terrain.sample(i, j) - landscape.height(x, y)) < 1e-15);
      CHECK(std::abs(terrain.height(x, y) - landscape.height(x, y)) < 1e-13);
      highest = std::max(highest, terrain.sample(i, j));
    }
  }
  CHECK(terrain.lowest() == highest);
}

TEST_CASE("ODE's ground is the terrain: the same triangles in the same places") {
  const Terrain terrain(kParameters);
  const Scene scene = scene_of(terrain, {{lentil(), 1}});
  const World world(scene, {{0, {0.05, 0.05, 0.1}, {1, 0, 0, 0}}});
  dGeomID ground = nullptr;
  for (dGeomID geom : world.walls().geoms()) {
    if (dGeomGetClass(geom) == dHeightfieldClass) ground = geom;
  }
  REQUIRE(ground != nullptr);
  dGeomID ray = dCreateRay(nullptr, 1);
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double x = 0.12 * random.uniform();
    const double y = 0.08 * random.uniform();
    CAPTURE(x);
    CAPTURE(y);
    dGeomRaySet(ray, x, y, 0.5, 0, 0, -1);
    dContactGeom hit;
    REQUIRE(dCollide(ray, ground, 1, &hit, sizeof hit) == 1);
    CHECK(std::abs(hit.pos[2] - terrain.height(x, y)) < 1e-12);
    CHECK(hit.normal[2] > 0);
    CHECK(terrain.contains({x, y, hit.pos[2] + 1e-9}));
    CHECK_FALSE(terrain.contains({x, y, hit.pos[2] - 1e-9}));
  }
  dGeomDestroy(ray);
}

TEST_CASE("beyond the walls of a terrain is outside") {
  const Terrain terrain(kParameters);
  CHECK(terrain.contains({0.06, 0.04, 0.1}));
  CHECK_FALSE(terrain.contains({-1e-9, 0.04, 0.1}));
  CHECK_FALSE(terrain.contains({0.1200001, 0.04, 0.1}));
  CHECK_FALSE(terrain.contains({0.06, 0.09, 0.1}));
  CHECK_FALSE(terrain.contains({0.06, -1e300, 0.1}));
  CHECK_FALSE(terrain.contains({NAN, 0.04, 0.1}));
  CHECK_FALSE(terrain.contains({0.06, 0.04, NAN}));
  CHECK_FALSE(terrain.contains({0.06, 0.04, INFINITY}));
}

TEST_CASE("round, flat and boxy grains fall on a terrain and stay on it") {
  const Scene scene = scene_of(Terrain(kParameters), {{lentil(), 20}, {die(), 10}});
  Simulation simulation(scene, 1);
  for (int step = 1; step <= 1600; ++step) simulation.advance(step * scene.time.step);  // to 0.8 s
  CHECK(simulation.watches.leaks.count() == 0);
  CHECK(simulation.stepper.contacts() >= 30);
  for (const Grain& grain : simulation.world.grains()) {  // on the ground or on one another, none in the air
    const Point p = grain.position();
    CHECK(p[2] - std::get<Terrain>(scene.container).height(p[0], p[1]) < 0.02);
  }
}
