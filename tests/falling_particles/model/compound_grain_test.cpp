// Grains of several bodies, superovoids and capsules: mass, places, contacts, measurements, pictures.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "input/catalogue.hpp"
#include "model/grain_shape.hpp"
#include "observe/bed.hpp"
#include "observe/pair_contact.hpp"
#include "output/frame.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;
using supernormal::test::relative;

namespace {

// The dumbbell of samples/compound at a tenth of its size, and a molar whose parts are apart.
constexpr const char* kCompoundsText = R"([dumbbell]
density = 7850
source = "samples/compound"
parts = [
  { half_axes = [1.4e-3, 1.4e-3, 8e-3], epsilon = 8 },
  { half_axes = [6e-3, 6e-3, 3e-3], epsilon = 6, position = [0, 0, 11e-3] },
  { half_axes = [6e-3, 6e-3, 3e-3], epsilon = 6, position = [0, 0, -11e-3] },
]
[molar]
source = "samples/compound"
parts = [
  { half_axes = [5.5e-3, 5e-3, 3.5e-3], delta = 3.5, epsilon = 4, taper = [0.15, 0.15], density = 2900 },
  { half_axes = [2e-3, 1.6e-3, 6e-3], epsilon = 3, taper = [0.5, 0.5], density = 2100, position = [0, 2.8e-3, -10e-3], axis = [1, 0, 0], angle = 7 },
  { half_axes = [2e-3, 1.6e-3, 6e-3], epsilon = 3, taper = [0.5, 0.5], density = 2100, position = [0, -2.8e-3, -10e-3], axis = [1, 0, 0], angle = -7 },
]
[egg]
half_axes = [3e-3, 3e-3, 4e-3]
delta = 2
epsilon = 2
taper = [0.3, 0.3]
density = 1000
source = "test"
[rod]
shape = "capsule"
radius = 2e-3
length = 8e-3
density = 1200
source = "test"
)";

std::vector<GrainKind> compounds(const std::string& text = kCompoundsText) {
  const TemporaryFolder folder;
  std::vector<GrainKind> kinds;
  for (const CatalogueEntry& entry : open_catalogue(folder.write("grains.toml", text))) kinds.push_back(entry.make());
  return kinds;
}

Scene scene_with(GrainKind kind, Container container = Box{{0.1, 0.1}}) {
  return scene_of(std::move(container), {{std::move(kind), 1}});
}

Component ball_at(double radius, double density, double x) { return {{{radius, radius, radius}}, density, {x, 0, 0}}; }

/// Mass and inertia about the centre of mass, by ODE's own sums over the components.
dMass assembled(const GrainKind& kind) {
  dInitODE2(0);
  dMass mass;
  dMassSetZero(&mass);
  for (const Component& component : kind.components) {
    const dGeomID geom = create_geom(nullptr, component.body);
    dMass share;
    REQUIRE(snMassSet(&share, component.density, geom) != 0);
    dGeomDestroy(geom);
    const auto [w, x, y, z] = component.quaternion;
    const dQuaternion quaternion = {w, x, y, z};
    dMatrix3 rotation;
    dRfromQ(rotation, quaternion);
    dMassRotate(&share, rotation);
    dMassTranslate(&share, component.position[0], component.position[1], component.position[2]);
    dMassAdd(&mass, &share);
  }
  dMassTranslate(&mass, -mass.c[0], -mass.c[1], -mass.c[2]);
  dCloseODE();
  return mass;
}

}  // namespace

TEST_CASE("compounds: mass and inertia about the centre of mass agree with ODE's own sums") {
  for (const GrainKind& kind : compounds()) {
    if (kind.components.empty()) continue;
    CAPTURE(kind.name);
    const dMass expected = assembled(kind);
    REQUIRE(kind.compound_mass.has_value());
    CHECK(kind.compound_mass->mass == relative(expected.mass).epsilon(1e-12));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        CHECK(std::abs(kind.compound_mass->inertia[i][j] - expected.I[4 * i + j]) < 1e-11 * expected.I[0]);
      }
    }
    const Scene scene = scene_with(kind);
    const World world(scene, {{0, {0.05, 0.05, 0.05}, {1, 0, 0, 0}, 2}});
    const Grain& grain = world.grains()[0];
    CHECK(grain.mass.mass == relative(8 * expected.mass).epsilon(1e-12));
    CHECK(grain.mass.I[0] == relative(32 * expected.I[0]).epsilon(1e-11));
    CHECK(grain.geoms().size() == kind.components.size());
    // The centre of mass, weighed part by part in the world.
    double moment = 0;
    const std::vector<dGeomID> geoms = grain.geoms();
    for (std::size_t component = 0; component < geoms.size(); ++component) {
      const dGeomID geom = geoms[component];
      dMass mass;
      REQUIRE(snMassSet(&mass, kind.components[component].density, geom) != 0);
      dMassRotate(&mass, dGeomGetRotation(geom));
      moment += mass.mass * (dGeomGetPosition(geom)[2] + mass.c[2] - 0.05);
    }
    CHECK(std::abs(moment) < 1e-12 * grain.mass.mass);
  }
}

TEST_CASE("compounds: volume that components share counts once, with the density of the first") {
  constexpr double kRadius = 3e-3, kDistance = 4e-3;
  const double sphere = 4 * std::numbers::pi / 3 * std::pow(kRadius, 3);
  const double lens = std::numbers::pi / 12 * std::pow(2 * kRadius - kDistance, 2) * (kDistance + 4 * kRadius);
  const GrainKind pair = make_compound("pair", {ball_at(kRadius, 1000, 0), ball_at(kRadius, 1000, kDistance)}, "test");
  CHECK(pair.compound_mass->mass == relative(1000 * (2 * sphere - lens)).epsilon(1e-5));
  CHECK(pair.density == relative(1000).epsilon(1e-12));
  CHECK(pair.components[0].position[0] == relative(-kDistance / 2).epsilon(1e-5));
  // About the common axis: two spheres without their lens. The integral of r^2 over the lens is the sum over its two caps.
  const double cap = kRadius - kDistance / 2;
  const double caps = std::numbers::pi * std::pow(cap, 3) * (20 * kRadius * kRadius - 15 * kRadius * cap + 3 * cap * cap) / 15;
  const double expected = 1000 * (2 * 0.4 * sphere * kRadius * kRadius - caps);
  CHECK(pair.compound_mass->inertia[0][0] == relative(expected).epsilon(1e-5));
  // A ball within another one is not there, but the other way round it is a core of another density.
  const GrainKind hidden = make_compound("hidden", {ball_at(3e-3, 1000, 0), ball_at(1e-3, 5000, 0)}, "test");
  CHECK(hidden.compound_mass->mass == relative(1000 * sphere).epsilon(1e-5));
  const GrainKind core = make_compound("core", {ball_at(1e-3, 5000, 0), ball_at(3e-3, 1000, 0)}, "test");
  CHECK(core.compound_mass->mass == relative(1000 * sphere * (1 + 4.0 / 27)).epsilon(1e-4));
  // Three in one place count once.
  const GrainKind thrice =
      make_compound("thrice", {ball_at(3e-3, 1000, 0), ball_at(3e-3, 1000, 0), ball_at(3e-3, 1000, 0)}, "test");
  CHECK(thrice.compound_mass->mass == relative(1000 * sphere).epsilon(1e-3));
}

TEST_CASE("compounds: the size of a dumbbell") {
  const GrainKind dumbbell = compounds()[0];
  CHECK(dumbbell.half_axes[0] == relative(6e-3).epsilon(1e-12));
  CHECK(dumbbell.half_axes[2] == relative(14e-3).epsilon(1e-12));
  CHECK(dumbbell.sieve_size() == relative(12e-3).epsilon(1e-12));
  CHECK(dumbbell.smallest_half_axis() == 1.4e-3);
  // The farthest points are on the rims of the discs.
  double farthest = 0;
  for (const auto& point : mesh_of(dumbbell, 0.02).points) farthest = std::max(farthest, point.norm());
  CHECK(dumbbell.bounding_radius() >= farthest);
  CHECK(dumbbell.bounding_radius() < 1.3 * farthest);
}

TEST_CASE("compounds: a dumbbell at rest carries its weight, and is one contact") {
  const Scene scene = scene_with(compounds()[0]);
  // On its side, bar along x.
  const World world(scene, {{0, {0.05, 0.05, 6.05e-3}, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}}});
  Stepper stepper(world, scene);
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) stepper.step(i == kSteps - 1);
  const Grain& grain = world.grains()[0];
  CHECK(grain.position()[2] == relative(6e-3).epsilon(2e-3));
  double force = 0;
  for (const MeasuredContact& contact : stepper.measured_contacts()) force += contact.force()[2];
  CHECK(force == relative(9.81 * grain.mass.mass).epsilon(2e-3));
  CHECK(stepper.measured_contacts().size() >= 2);  // both discs
  const std::vector<PairContact> pairs = gather_contacts(stepper.measured_contacts(), world, scene.time.step);
  REQUIRE(pairs.size() == 1);
  CHECK(pairs[0].normal_force() == relative(9.81 * grain.mass.mass).epsilon(2e-3));
  CHECK(pairs[0].position.x() == relative(0.05).epsilon(1e-2));  // between the discs
}

TEST_CASE("compounds: two dumbbells that lie on one another in two places are one pair") {
  Scene scene = scene_with(compounds()[0]);
  scene.kinds[0].count = 2;
  const std::array<double, 4> on_side = {std::sqrt(0.5), 0, std::sqrt(0.5), 0};
  const World world(scene, {{0, {0.05, 0.05, 6e-3}, on_side}, {0, {0.05, 0.05, 18e-3 - 2e-5}, on_side}});
  Stepper stepper(world, scene);
  stepper.step(true);
  const auto meet = [](const MeasuredContact& contact) {
    return grain_of(contact.geom.g1) != nullptr && grain_of(contact.geom.g2) != nullptr;
  };
  CHECK(std::ranges::count_if(stepper.measured_contacts(), meet) >= 2);
  const std::vector<PairContact> pairs = gather_contacts(stepper.measured_contacts(), world, scene.time.step);
  CHECK(std::ranges::count_if(pairs, [](const PairContact& pair) { return pair.grain2 != nullptr; }) == 1);
  // The parts of one body do not meet: bar and discs touch.
  for (const dContactGeom& contact : stepper.contact_geoms()) CHECK(grain_of(contact.g1) != grain_of(contact.g2));
}

TEST_CASE("compounds: grains collide across a periodic boundary as in the middle of the cell") {
  const auto motion_at = [](double offset) {
    constexpr double kSide = 0.08;
    Scene scene = scene_with(compounds()[0], Periodic{kSide});
    scene.kinds[0].count = 2;
    scene.effects.clear();
    scene.solver.iterations = 500;
    const double middle = kSide / 2 + offset;
    const World world(
        scene, {{0, {middle - 6.1e-3, middle, middle}, {1, 0, 0, 0}}, {0, {middle + 6.1e-3, middle, middle + 4e-3}, {1, 0, 0, 0}}});
    dBodySetLinearVel(world.grains()[0].body, 0.2, 0, 0);
    dBodySetLinearVel(world.grains()[1].body, -0.2, 0, 0);
    Stepper stepper(world, scene);
    for (int i = 0; i < 20; ++i) stepper.step();
    const dReal* v = dBodyGetLinearVel(world.grains()[0].body);
    const dReal* w = dBodyGetAngularVel(world.grains()[0].body);
    return std::array<double, 6>{v[0], v[1], v[2], w[0], w[1], w[2]};
  };
  const auto expected = motion_at(0);
  CHECK(expected[0] < 0.15);  // they have met
  const auto found = motion_at(0.04);
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(found[i] - expected[i]) < 0.02 * (i < 3 ? 0.2 : 0.2 / 6e-3));
}

TEST_CASE("compounds: the volume of a bed is the volume of the components") {
  const Scene scene = scene_with(compounds()[0], Box{{0.03, 0.03}});
  const World world(scene, {{0, {0.015, 0.015, 14e-3}, {1, 0, 0, 0}}});
  Random random(3);
  const Bed bed = measure_bed(world, std::get<Box>(scene.container), random);
  CHECK(bed.height == relative(28e-3).epsilon(1e-9));
  CHECK(bed.volume_fraction > 0);
  CHECK(bed.bulk_density == relative(7850 * bed.volume_fraction).epsilon(1e-9));
}

TEST_CASE("compounds: the meshes of pictures are where the geoms are") {
  const Scene scene = scene_with(compounds()[1]);
  const World world(scene, {{0, {0.05, 0.05, 0.05}, {0.5, 0.5, 0.5, 0.5}, 1.5}});
  const Grain& grain = world.grains()[0];
  Contents contents = contents_of(world, scene);
  contents.scale_of_grain = {1.5};
  const std::vector<ShownComponent> components = shown_components(frame_of(0, {}, contents, world, nullptr), contents);
  REQUIRE(components.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(components[k].position[i] - dGeomGetPosition(grain.geoms()[k])[i]) < 1e-15);
    CHECK(components[k].body.half_axes[0] == 1.5 * scene.kinds[0].kind.components[k].body.half_axes[0]);
    CHECK(components[k].grain == 0);
  }
  // Every corner of the mesh, scaled and turned, is on the boundary of a part.
  for (const auto& point : mesh_of(scene.kinds[0].kind, 0.05).points) {
    dVector3 at;
    dBodyGetRelPointPos(grain.body, 1.5 * point.x(), 1.5 * point.y(), 1.5 * point.z(), at);
    double nearest = 1;
    for (const dGeomID geom : grain.geoms()) nearest = std::min(nearest, std::abs(snGeomPointDepth(geom, at[0], at[1], at[2])));
    CHECK(nearest < 1e-9);
  }
}

TEST_CASE("capsules: mass, size and rest heights") {
  const GrainKind rod = compounds()[3];
  CHECK(rod.is_capsule);
  CHECK(rod.half_axes == std::array<double, 3>{2e-3, 2e-3, 6e-3});
  CHECK(rod.bounding_radius() == 6e-3);
  const Scene scene = scene_with(rod);
  // One lies, one stands: it would fall over, but not within the time that the other takes to rest.
  const World world(scene,
                    {{0, {0.05, 0.03, 2.02e-3}, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}}, {0, {0.05, 0.07, 6.02e-3}, {1, 0, 0, 0}}});
  dMass expected;
  dMassSetCapsule(&expected, 1200, 3, 2e-3, 8e-3);
  CHECK(world.grains()[0].mass.mass == relative(expected.mass).epsilon(1e-12));
  for (const int i : {0, 5, 10}) CHECK(world.grains()[0].mass.I[i] == relative(expected.I[i]).epsilon(1e-11));
  Stepper stepper(world, scene);
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) stepper.step(i == kSteps - 1);
  CHECK(world.grains()[0].position()[2] == relative(2e-3).epsilon(3e-3));
  CHECK(world.grains()[1].position()[2] == relative(6e-3).epsilon(1e-3));
  double lying = 0;
  int points = 0;
  for (const MeasuredContact& contact : stepper.measured_contacts()) {
    const Grain* grain = grain_of(contact.geom.g1) != nullptr ? grain_of(contact.geom.g1) : grain_of(contact.geom.g2);
    if (grain != &world.grains()[0]) continue;
    lying += contact.force()[2];
    ++points;
  }
  CHECK(points >= 2);  // both ends
  CHECK(lying == relative(9.81 * expected.mass).epsilon(1e-3));
}

TEST_CASE("compounds: every mistake in a catalogue ends with one line") {
  const std::vector<Mistake> mistakes = {
      {"radius = 2e-3", "radius = 0", {"grains.toml:25: rod.radius is 0", "(0, 1] m"}},
      {"length = 8e-3", "length = -1", {"rod.length is -1", "of the cylinder between the caps"}},
      {R"(shape = "capsule")", R"(shape = "sphere")", {R"(rod.shape is "sphere")", "superellipsoid, capsule"}},
      {"taper = [0.3, 0.3]", "taper = [0.9, 0.9]", {"egg.taper: taper", "0.9"}},
      {"density = 7850", "", {"dumbbell.density is missing"}},
      {", angle = 7 }", " }", {"molar.parts.angle is missing", "degrees"}},
      {"axis = [1, 0, 0], angle = 7 ", "axis = [0, 0, 0], angle = 7 ", {"molar.parts.axis is [0, 0, 0]"}},
      {"position = [0, 0, 11e-3]", "place = [0, 0, 11e-3]", {R"(unknown key "place" in [dumbbell.parts])"}},
      {"density = 7850", "density = 7850\ndelta = 2", {R"(unknown key "delta" in [dumbbell])", "parts"}},
  };
  for (const Mistake& mistake : mistakes) {
    CAPTURE(mistake.to);
    check_says(complaint(kSceneText, replaced(kCompoundsText, mistake.from, mistake.to)), mistake.says);
  }
}
