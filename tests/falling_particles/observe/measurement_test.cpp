#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "model/container.hpp"
#include "observe/bed.hpp"
#include "observe/energy.hpp"
#include "output/frame.hpp"
#include "support/relative.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;
namespace fx = supernormal::effects;

namespace {

GrainKind ellipsoid() { return {"ellipsoid", {0.02, 0.03, 0.01}, 2, 2, 0, 1000, "typical"}; }

Scene scene_of(const GrainKind& kind, int count) {
  return {.name = "test",
          .seed = 1,
          .container = Box{{0.2, 0.2}},
          .kinds = {{kind, count}},
          .drop = {0, 0},
          .time = {1, 1e-3, 0.1},
          .solver = {50, 0.2, 1e-10},
          .effects = {fx::Gravity{{0, 0, -10}}, fx::MaxCorrectingVelocity{1}, fx::SurfaceLayer{1e-3 * kind.smallest_half_axis()}},
          .walls = walls_in(Box{{0.2, 0.2}})};
}

Placement upright(double x, double y, double z) { return {0, {x, y, z}, {1, 0, 0, 0}}; }

}  // namespace

TEST_CASE("energy of a moving ellipsoid") {
  const Scene scene = scene_of(ellipsoid(), 1);
  const World world(scene, {upright(0.1, 0.1, 0.05)});
  const Grain& grain = world.grains().front();
  const double mass = 1000 * 4.0 / 3 * std::numbers::pi * 0.02 * 0.03 * 0.01;
  dBodySetLinearVel(grain.body, 1, 2, 2);
  dBodySetAngularVel(grain.body, 0, 0, 7);
  const double inertia = mass / 5 * (0.02 * 0.02 + 0.03 * 0.03);
  const Energy energy = measure_energy(world, scene);
  CHECK(energy.kinetic == supernormal::test::relative(0.5 * mass * 9 + 0.5 * inertia * 49).epsilon(1e-12));
  CHECK(energy.potential == supernormal::test::relative(mass * 10 * 0.05).epsilon(1e-12));
  CHECK(kinetic_height(world, scene) == supernormal::test::relative(energy.kinetic / (mass * 10)).epsilon(1e-12));
}

TEST_CASE("the energy that grains gain and lose is watched over all steps") {
  const Scene scene = scene_of(ellipsoid(), 2);
  const World world(scene, {upright(0.05, 0.05, 0.05), upright(0.15, 0.15, 0.05)});
  const Grain& grain = world.grains().back();
  EnergyWatch watch(world, scene);
  // One of the two grains moves down by 20 mm, up by 5, down by 10, up by 8.
  for (const double height : {0.03, 0.035, 0.025, 0.033}) {
    dBodySetPosition(grain.body, 0.15, 0.15, height);
    watch.after_step();
  }
  const double weight = grain.mass.mass * 10;
  CHECK(watch.lost() == supernormal::test::relative(weight * 0.025).epsilon(1e-12));
  CHECK(watch.gained() == supernormal::test::relative(weight * 0.008).epsilon(1e-12));
  dBodySetLinearVel(grain.body, 0, 0, 3);
  CHECK(largest_kinetic_energy(world) == supernormal::test::relative(0.5 * grain.mass.mass * 9).epsilon(1e-12));
}

TEST_CASE("the deepest overlap is found, between grains and with walls") {
  const Scene scene = scene_of(ellipsoid(), 3);
  // The half-axis along x is 0.02: the first two overlap by 1 mm, the third is 3 mm deep in the wall x = 0.2.
  const World world(scene, {upright(0.05, 0.1, 0.1), upright(0.089, 0.1, 0.1), upright(0.183, 0.1, 0.1)});
  const Overlap overlap = measure_overlap(world);
  CHECK(overlap.pairs == 2);
  CHECK(overlap.depth == supernormal::test::relative(3e-3).epsilon(1e-9));
  CHECK(overlap.relative_to_pair == supernormal::test::relative(0.3).epsilon(1e-9));
  CHECK(count_outside(world) == 0);
  dBodySetPosition(world.grains()[0].body, 0.05, 0.1, -0.001);
  CHECK(count_outside(world) == 1);
}

TEST_CASE("nothing overlaps when all are apart") {
  const Scene scene = scene_of(ellipsoid(), 2);
  const World world(scene, {upright(0.05, 0.1, 0.1), upright(0.0901, 0.1, 0.1)});
  const Overlap overlap = measure_overlap(world);
  CHECK(overlap.pairs == 0);
  CHECK(overlap.depth == 0);
}

TEST_CASE("the volume fraction is that of a known bed") {
  // One layer of four bodies that are nearly boxes: from z = 0.02 to 0.08 it fills 4 * 0.08^2 / 0.2^2 of the area.
  const GrainKind box{"box", {0.04, 0.04, 0.04}, 200, 200, 0, 1000, "typical"};
  const Scene scene = scene_of(box, 4);
  const World world(scene,
                    {upright(0.05, 0.05, 0.05), upright(0.15, 0.05, 0.05), upright(0.05, 0.15, 0.05), upright(0.15, 0.15, 0.05)});
  Random random(1);
  const Bed bed = measure_bed(world, std::get<Box>(scene.container), random);
  CHECK(bed.height == supernormal::test::relative(0.1).epsilon(1e-12));  // twice the height of the centres
  // The slab reaches from 0.005 to 0.08, the boxes from 0.01 to 0.09: 14/15 of it.
  const double expected = 0.64 * 14 / 15;
  CHECK(std::abs(bed.volume_fraction - expected) < 4 * bed.standard_error + 0.02 * expected);  // edges: exponent 200
  CHECK(bed.standard_error < 0.002);
}

TEST_CASE("a grain that overlaps another counts once") {
  const Scene scene = scene_of(ellipsoid(), 2);
  const World once(scene, {upright(0.1, 0.1, 0.05)});
  const World twice(scene, {upright(0.1, 0.1, 0.05), upright(0.1, 0.1, 0.05)});
  Random first(1);
  Random second(1);
  CHECK(measure_bed(once, std::get<Box>(scene.container), first).volume_fraction ==
        measure_bed(twice, std::get<Box>(scene.container), second).volume_fraction);
}

TEST_CASE("a dropped grain falls freely, comes to rest on the floor and touches it in one contact") {
  const Scene scene = scene_of(ellipsoid(), 1);
  const World world(scene, {upright(0.1, 0.1, 0.06)});
  Stepper stepper(world, scene);
  const dReal* position = dBodyGetPosition(world.grains()[0].body);
  constexpr int kFree = 90;  // steps, of the 100 ms that 0.05 m take
  for (int i = 0; i < kFree; ++i) stepper.step();
  CHECK(stepper.contacts() == 0);
  // The semi-implicit Euler method gives z = -g dt^2 n (n + 1) / 2.
  CHECK(position[2] == supernormal::test::relative(0.06 - 10 * 1e-6 * kFree * (kFree + 1) / 2).epsilon(1e-9));
  for (int i = 0; i < 1000; ++i) stepper.step();
  CHECK(stepper.contacts() == 1);
  CHECK(std::abs(position[2] - 0.01) < 1e-3 * 0.01 + 1e-5);
  CHECK(kinetic_height(world, scene) < 1e-9);
  CHECK(stepper.costs().pairs_tested >= stepper.costs().contacts);
}

TEST_CASE("the contacts of a frame carry the weight of the grains, and measuring them changes no motion") {
  const Scene scene = scene_of(ellipsoid(), 2);
  const std::vector<Placement> start = {upright(0.05, 0.1, 0.01), upright(0.1, 0.1, 0.01)};
  const auto settle = [&](bool measures, Frame* frame) {
    const World world(scene, start);
    Stepper stepper(world, scene);
    for (int i = 0; i < 500; ++i) stepper.step(measures);
    if (frame != nullptr) *frame = frame_of(0.5, {}, contents_of(world, scene), world, &stepper);
    return world.grains()[1].position();
  };
  Frame frame;
  CHECK(settle(true, &frame) == settle(false, nullptr));
  REQUIRE(frame.contacts.size() == 2);
  const double weight = 10 * scene.kinds[0].kind.density * 4 * std::numbers::pi / 3 * 0.02 * 0.03 * 0.01;
  for (const ContactState& contact : frame.contacts) {
    REQUIRE(contact.force.has_value());
    // On body 1, whichever of the two the grain is; the normal points into it.
    const double sign = contact.grain1 == kWall ? -1 : 1;
    CHECK(contact.normal[2] == doctest::Approx(sign));
    CHECK((*contact.force)[2] == doctest::Approx(sign * weight).epsilon(1e-3));
  }
}
