#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/random.hpp"
#include "complaint.hpp"
#include "observe/overlap.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/compression.hpp"
#include "world/placement.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;

namespace {

constexpr double kSide = 0.04;  // m

GrainKind bean() { return {"bean", {6e-3, 4e-3, 3e-3}, 2, 2, 0, 1000, "test"}; }

Scene weightless(double side, const GrainKind& kind, int count) {
  Scene scene = scene_of(Periodic{side}, {{kind, count}});
  scene.effects.clear();
  return scene;
}

struct Motion {
  std::array<double, 3> position, velocity, spin;
};

Motion motion_of(const Grain& grain) {
  const dReal* v = dBodyGetLinearVel(grain.body);
  const dReal* w = dBodyGetAngularVel(grain.body);
  return {grain.position(), {v[0], v[1], v[2]}, {w[0], w[1], w[2]}};
}

/// Lets two beans meet off-centre, `offset` away from where the cell's boundary does not matter.
std::vector<Motion> collide_at(double offset, bool rough) {
  Scene scene = weightless(kSide, bean(), 2);
  if (rough) scene.effects = {supernormal::effects::Friction{0.3, {}}};
  scene.solver.iterations = 500;  // the ties converge slowly
  const double middle = kSide / 2 + offset;
  const World world(scene, {{0, {middle - 7.2e-3, middle, middle}, {0.9, 0.1, 0.2, 0.3}},
                            {0, {middle + 7.2e-3, middle + 2e-3, middle + 1e-3}, {0.8, -0.3, 0.4, 0.1}}});
  dBodySetLinearVel(world.grains()[0].body, 0.5, 0, 0);
  dBodySetLinearVel(world.grains()[1].body, -0.5, 0, 0.1);
  Stepper stepper(world, scene);
  std::size_t contacts = 0;
  for (int i = 0; i < 20; ++i) {
    stepper.step();
    contacts += stepper.contacts();
  }
  CHECK(contacts > 0);
  return {motion_of(world.grains()[0]), motion_of(world.grains()[1])};
}

}  // namespace

TEST_CASE("grains collide across the boundary as in the middle of the cell") {
  for (const bool rough : {false, true}) {
    CAPTURE(rough);
    const std::vector<Motion> expected = collide_at(0, rough);
    CHECK(std::abs(expected[0].spin[0]) + std::abs(expected[0].spin[1]) + std::abs(expected[0].spin[2]) > 1);
    const std::vector<Motion> across = collide_at(kSide / 2, rough);  // in the corner: through all three boundaries
    for (std::size_t body = 0; body < 2; ++body) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CAPTURE(body);
        CAPTURE(axis);
        CHECK(std::abs(across[body].velocity[axis] - expected[body].velocity[axis]) < 1e-4);
        CHECK(std::abs(across[body].spin[axis] - expected[body].spin[axis]) < 0.05);
        const double apart = across[body].position[axis] - expected[body].position[axis] - kSide / 2;
        CHECK(std::abs(std::remainder(apart, kSide)) < 2e-5);
      }
    }
  }
}

TEST_CASE("a simple cubic lattice has volume fraction pi / 6 and six contacts per grain, also through boundaries") {
  constexpr int kPerAxis = 3;
  constexpr double kShrink = 1e-5;
  const double spacing = 0.01 * (1 - kShrink);
  const Scene scene = weightless(kPerAxis * spacing, ball(), kPerAxis * kPerAxis * kPerAxis);
  std::vector<Placement> placements;
  for (int i = 0; i < scene.grains_at_start(); ++i) {
    const std::array<int, 3> index = {i % 3, i / 3 % 3, i / 9};
    placements.push_back({0, {(index[0] + 0.3) * spacing, (index[1] + 0.6) * spacing, index[2] * spacing}, {1, 0, 0, 0}});
  }
  const World world(scene, placements);
  const Overlap overlap = [&world] {
    world.cell()->place_images();
    return measure_overlap(world);
  }();
  CHECK(overlap.pairs == 81);  // six for each of 27, every pair once
  CHECK(overlap.depth == supernormal::test::relative(0.01 * kShrink).epsilon(1e-6));

  Stepper stepper(world, scene);
  stepper.step();
  const Compression compression{1e-5, 1e-5, 1};
  Compressor compressor(world, *world.cell(), compression, 1);
  compressor.after_step(0, stepper.contact_geoms());
  const Packing& packing = compressor.packing();
  CHECK(packing.contacts_per_grain == 6);
  CHECK(packing.volume_fraction == supernormal::test::relative(std::numbers::pi / 6 * (1 + 3 * kShrink)).epsilon(1e-9));
  CHECK(packing.overlap.relative == supernormal::test::relative(kShrink).epsilon(1e-6));
  CHECK(packing.at_contact == supernormal::test::relative(std::numbers::pi / 6).epsilon(1e-9));
}

TEST_CASE("a contact counts once for the compression, with any number of points and at any boundary") {
  const GrainKind brick = {"brick", {6e-3, 5e-3, 4e-3}, 40, 40, 0, 1000, "test"};
  constexpr double kDepth = 1e-5;
  for (const double place : {0.5, 0.0, 0.97}) {  // of the cell's side
    CAPTURE(place);
    const Scene scene = weightless(kSide, brick, 2);
    const double at = place * kSide;
    const World world(scene, {{0, {at, at, at}, {1, 0, 0, 0}}, {0, {at, at, at + 8e-3 - kDepth}, {1, 0, 0, 0}}});
    Stepper stepper(world, scene);
    stepper.step();
    CHECK(stepper.contacts() > 1);
    const MeanOverlap overlap = measure_mean_overlap(stepper.contact_geoms());
    CHECK(overlap.contacts == 1);
    // The step has pushed the bricks apart by a part of the depth.
    CHECK(overlap.relative == supernormal::test::relative(kDepth / 8e-3).epsilon(kDepth / 8e-3));
  }
}

TEST_CASE("compression jams grains with the scene's overlap") {
  Scene scene = weightless(0.05, ball(), 60);
  scene.solver = {30, 0.8, 1e-10};
  constexpr int kSteps = 2000;
  scene.compression = Compression{1e-2, 1e-3, 1};
  Random random(3);
  const World world(scene, place(scene, random));
  Stepper stepper(world, scene);
  Compressor compressor(world, *world.cell(), *scene.compression, kSteps);
  for (int i = 1; i <= kSteps; ++i) {
    stepper.step();
    compressor.after_step(i, stepper.contact_geoms());
  }
  const Packing& packing = compressor.packing();
  CHECK(packing.overlap.relative == supernormal::test::relative(1e-3).epsilon(0.3));
  // 60 spheres jam anywhere between the loosest packings known and the crystal's 0.7405, most of them close to 0.63.
  CHECK(packing.at_contact > 0.59);
  CHECK(packing.at_contact < 0.68);
  CHECK(packing.contacts_per_grain > 4);
  CHECK(packing.at_contact == supernormal::test::relative(packing.volume_fraction * (1 - 3e-3)).epsilon(2e-3));
}

TEST_CASE("mistakes in a scene with a periodic cell are refused with the reason") {
  const std::string periodic = replaced(scene_in("kind = \"periodic\"\nside = 0.05"), "[drop]\nheight = 0.01\ngap = 0.1\n", "") +
                               "[compression]\noverlap = 0.01\nfinal_overlap = 1e-3\ndamping = 1\n";
  CHECK(complaint(periodic).empty());
  check_says(complaint(replaced(periodic, "side = 0.05", "side = 0.02")), {"container.side is 0.02; allowed: at least 0.0"});
  check_says(complaint(replaced(periodic, "final_overlap = 1e-3", "final_overlap = 0.02")),
             {"compression.final_overlap is 0.02;", "up to compression.overlap"});
  check_says(complaint(replaced(periodic, "damping = 1", "damping = 2")), {"compression.damping is 2;", "[0, 1]"});
  check_says(complaint(std::string(kSceneText) + "[compression]\noverlap = 0.01\nfinal_overlap = 1e-3\ndamping = 1\n"),
             {"compression in a box; allowed: in a periodic container"});
}
