// Tests of sheets that hold grains on both sides.

#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "common/random.hpp"
#include "scenes.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;
namespace fx = supernormal::effects;

namespace {

/// A square of 10 cm around the origin, seen from above. It is a bowl with spikes of `roughness` (m).
Mesh sheet(double roughness) {
  constexpr unsigned int kSide = 12;
  Mesh mesh;
  Random random(7);
  for (unsigned int j = 0; j <= kSide; ++j) {
    for (unsigned int i = 0; i <= kSide; ++i) {
      const double x = 0.1 * i / kSide - 0.05, y = 0.1 * j / kSide - 0.05;
      const double z = 8 * (x * x + y * y) + roughness * random.uniform();
      mesh.vertices.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    }
  }
  for (unsigned int j = 0; j < kSide; ++j) {
    for (unsigned int i = 0; i < kSide; ++i) {
      const unsigned int a = j * (kSide + 1) + i, b = a + kSide + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, b + 1}, {a, b + 1, b}});
    }
  }
  return mesh;
}

/// The same triangles, seen from the other side.
Mesh turned(Mesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

/// The places of twelve grains after 0.25 s, when all have fallen into a bowl.
std::vector<Point> fall_on(const Mesh& mesh) {
  Scene scene = scene_of(Open{{{-0.1, -0.1, 0}, {0.2, 0.2, 1}}, {{-1, -1, -1}, {2, 2, 3}}}, {{ball(), 6}, {lentil(), 6}});
  scene.walls = {{"sheet", mesh}};
  scene.effects = {fx::Gravity{{0, 0, -9.81}}, fx::Friction{0.4, {}}, fx::MaxCorrectingVelocity{0.05}};
  std::vector<Placement> placements;
  Random random(3);
  for (int i = 0; i < 12; ++i) {
    const Point place = {0.06 * random.uniform() - 0.03, 0.06 * random.uniform() - 0.03, 0.03 + 0.012 * (i + 1)};
    placements.push_back({i < 6 ? 0U : 1U, place, random.rotation()});
  }
  World world(scene, placements);
  Stepper stepper(world, scene);
  for (int step = 0; step < 500; ++step) stepper.step();
  std::vector<Point> places;
  for (const Grain& grain : world.grains()) places.push_back(grain.position());
  return places;
}

}  // namespace

TEST_CASE("a sheet with a thickness holds grains on both sides, and is closed") {
  for (const double roughness : {0.0, 4e-3, 0.02}) {  // the last one with ridges sharper than a right angle
    for (const double thickness : {1e-4, 2e-3}) {
      CAPTURE(roughness);
      CAPTURE(thickness);
      const Mesh bowl = sheet(roughness);
      for (const Mesh& wound : {bowl, turned(bowl)}) {
        const Mesh shell = shell_of(wound, thickness).value();
        CHECK(solid_of(shell).has_value());
        for (const Point& place : fall_on(shell)) CHECK(place[2] > 0);  // none has fallen through
      }
    }
  }
  const Mesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  CHECK(solid_of(shell_of(square, 0.1).value())->volume == doctest::Approx(0.1));
}
