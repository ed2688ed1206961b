
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/random.hpp"
#include "model/container.hpp"
#include "model/periodic_walls.hpp"
#include "observe/bed.hpp"
#include "observe/energy.hpp"
#include "observe/leaks.hpp"
#include "observe/measured.hpp"
#include "observe/simulation.hpp"
#include "observe/wall_mesh.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/periodic_cell.hpp"
#include "world/placement.hpp"
#include "world/population.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;
using supernormal::test::relative;
namespace fx = supernormal::effects;

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

/// kSceneText in a box that repeats along the axes of these lines.
std::string periodic_text(const std::string& lines) { return std::string(kSceneText) + "[periodic]\n" + lines; }

double momentum(const World& world) {
  double sum = 0;
  for (const Grain& grain : world.present()) sum += grain.mass.mass * dBodyGetLinearVel(grain.body)[0];
  return sum;
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

TEST_CASE("a grain keeps its velocity through a periodic boundary, and meets a grain on the other side") {
  Scene scene = scene_of(Box{{0.06, 0.05}}, {{ball(), 2}});
  scene.effects.clear();
  scene.solver.iterations = 200;
  scene.periodic[0] = Period{0, 0.06};
  open_container(scene.periodic, 0.02, scene.walls.size(), scene.walls);
  const World world(scene, {{0, {0.05, 0.025, 0.02}, {1, 0, 0, 0}}, {0, {0.02, 0.025, 0.02}, {1, 0, 0, 0}}});
  CHECK(world.walls().geoms().size() == 3);  // the floor and the walls across y
  const Grain& moving = world.grains()[0];
  const Grain& resting = world.grains()[1];
  dBodySetLinearVel(moving.body, 0.5, 0, 0);
  const double before = momentum(world);
  Stepper stepper(world, scene);
  LeakWatch leaks(world);
  int steps = 0;
  while (stepper.contacts() == 0) {
    REQUIRE(steps < 200);
    const std::array<double, 2> velocity = {dBodyGetLinearVel(moving.body)[0], dBodyGetLinearVel(moving.body)[1]};
    CHECK(velocity[0] == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(std::abs(velocity[1]) < 1e-12);
    stepper.step();
    leaks.after_step(++steps * scene.time.step);
  }
  // 0.02 m from centre to centre through the boundary, less the two radii.
  CHECK(steps * scene.time.step == relative(0.02 / 0.5).epsilon(0.03));
  CHECK(world.place_of(moving)[0] == doctest::Approx(0.01).epsilon(0.03));
  CHECK(leaks.count() == 0);
  CHECK(dBodyGetLinearVel(resting.body)[0] > 0.2);
  CHECK(momentum(world) == relative(before).epsilon(1e-6));
  stepper.step();
  CHECK(momentum(world) == relative(before).epsilon(1e-6));
}

TEST_CASE("the stress of a periodic bed balances its weight, and the floor bears the weight") {
  constexpr double kGravity = 9.81;
  const std::string lines = "x = [0, 0.05]\ny = [0, 0.06]\n";
  const std::string text =
      replaced(replaced(periodic_text(lines), "count = 5", "count = 150"), "iterations = 20", "iterations = 100");
  const Scene scene = scene_with("kind = \"stress\"\nlower = [0, 0, 0]\nupper = [0.05, 0.06, 0.2]\n", text);
  Random random(1);
  const World world(scene, place(scene, random));
  REQUIRE(world.walls().geoms().size() == 1);
  Stepper stepper(world, scene);
  LeakWatch leaks(world);
  constexpr int kSettling = 1600, kSamples = 100;
  double stress = 0, moment = 0, floor = 0, weight = 0;
  for (int step = 1; step <= kSettling + kSamples; ++step) {
    stepper.step(step > kSettling);
    leaks.after_step(step * scene.time.step);
    if (step <= kSettling) continue;
    stress += measure(scene, world, &stepper).number("contact_zz_Pa") / kSamples;
    for (const MeasuredContact& contact : stepper.measured_contacts()) {
      if (grain_of(contact.geom.g1) == nullptr || grain_of(contact.geom.g2) == nullptr)
        floor += std::abs(contact.force()[2]) / kSamples;
    }
    for (const Grain& grain : world.present()) moment += grain.mass.mass * kGravity * grain.position()[2] / kSamples;
  }
  for (const Grain& grain : world.present()) weight += grain.mass.mass * kGravity;
  CHECK(leaks.count() == 0);
  CHECK(floor == relative(weight).epsilon(0.02));
  // In equilibrium the integral of the stress is the sum of weight times height.
  CHECK(stress * (0.05 * 0.06 * 0.2) == relative(moment).epsilon(0.02));
  // No wall, so no loose layer beside one.
  const Bed bed = measure_bed(world, std::get<Box>(scene.container), random);
  CHECK(bed.volume_fraction > 0.5);
  CHECK(bed.volume_fraction < 0.75);
}

TEST_CASE("grains on a face, an edge and a corner of a periodic scene have one, one and three images") {
  Scene scene = scene_of(Box{{0.06, 0.05}}, {{ball(), 3}});
  scene.effects.clear();
  scene.periodic = {Period{0, 0.06}, Period{0, 0.05}, std::nullopt};
  open_container(scene.periodic, 0.02, scene.walls.size(), scene.walls);
  const World world(
      scene,
      {{0, {0.059, 0.025, 0.02}, {1, 0, 0, 0}}, {0, {0.03, 0.049, 0.02}, {1, 0, 0, 0}}, {0, {0.059, 0.049, 0.2}, {1, 0, 0, 0}}});
  world.cell()->place_images();
  std::size_t geoms = 0;
  world.for_each_grain_geom([&geoms](dGeomID) { ++geoms; });
  CHECK(geoms == 3 + 1 + 1 + 3);
}

TEST_CASE("a drum that is periodic along its axis has no ends, and keeps its grains") {
  const std::string text =
      replaced(scene_in("kind = \"drum\"\ndiameter = 0.12\nlength = 0.05\nsegments = 32\nrpm = 60"), "count = 2", "count = 20") +
      "[periodic]\ny = [0, 0.05]\n";
  const Scene scene = scene_of(text);
  REQUIRE(scene.walls.size() == 1);
  CHECK(scene.walls[0].name == "drum");
  double least = 0, most = 0;
  for (const auto& vertex : std::get<MeshShape>(scene.walls[0].shape).vertices) {
    least = std::min<double>(least, vertex[1]);
    most = std::max<double>(most, vertex[1]);
  }
  CHECK(least <= -2 * scene.largest_bounding_radius() * (1 - 1e-6));
  CHECK(most >= 0.05 + 2 * scene.largest_bounding_radius() * (1 - 1e-6));
  Simulation simulation(scene, 1);
  const World& world = simulation.world;
  for (int step = 1; step <= 2000; ++step) simulation.advance(step * scene.time.step);
  CHECK(simulation.watches.leaks.count() == 0);
  double x = 0;
  for (const Grain& grain : world.present()) x += grain.position()[0] / static_cast<double>(world.grains().size());
  CHECK(x < -0.003);  // it is carried up on the side to which the floor moves
}

TEST_CASE("feeders and sinks work in a periodic scene, with the same numbers on any number of threads") {
  const std::string text = replaced(periodic_text("x = [0, 0.05]\ny = [0, 0.06]\n"), "[drop]\nheight = 0.01\ngap = 0.1\n", "") + R"(
[[feeder]]
name = "rain"
corner = [0, 0, 0.05]
size = [0.05, 0.06, 0.03]
velocity = [0.3, 0.3, -0.5]
grains_per_second = 400
[[sink]]
name = "hole"
corner = [0, 0, 0]
size = [0.02, 0.02, 0.02]
)";
  const Scene scene = scene_of(
      replaced(replaced(replaced(text, "count = 5", "count = 0"), "count = 2", "count = 0"), "duration = 0.1", "duration = 1") +
      "[[feeder.grain]]\nname = \"pea\"\nfraction = 1\n");
  std::vector<std::vector<Point>> ends;
  for (const int threads : {1, 2}) {
    Simulation simulation(scene, threads);
    const World& world = simulation.world;
    const Population& population = simulation.population;
    for (int step = 1; step <= 800; ++step) simulation.advance(step * scene.time.step);
    CHECK(simulation.watches.leaks.count() == 0);
    CHECK(population.fed().grains == 160);
    CHECK(population.taken().grains > 0);
    CHECK(population.present().grains == 160 - population.taken().grains);
    CHECK(population.present().mass + population.taken().mass == relative(population.fed().mass).epsilon(1e-12));
    std::vector<Point>& end = ends.emplace_back();
    for (const Grain& grain : world.present()) end.push_back(grain.position());
  }
  CHECK(ends[0] == ends[1]);
}

TEST_CASE("a feeder that has not started changes nothing") {
  Scene scene = scene_of(kSceneText);
  std::vector<std::vector<Point>> ends;
  for (const bool has_feeder : {false, true}) {
    if (has_feeder) {
      scene.feeders = {
          {"late", {{0.01, 0.01, 0.1}, {0.02, 0.02, 0.02}}, {{0, 1}}, Quantity::Of::Grains, {10, Quantity::Of::Grains}}};
      scene.feeders[0].from = 100;
    }
    Random random(scene.seed);
    World world(scene, place(scene, random));
    Population population(world, scene);
    Stepper stepper(world, scene);
    for (int step = 1; step <= 200; ++step) {
      CHECK(population.before_step(step * scene.time.step) == 0);
      stepper.step();
    }
    std::vector<Point>& end = ends.emplace_back();
    for (const Grain& grain : world.grains()) end.push_back(grain.position());
  }
  CHECK(ends[0] == ends[1]);
}

TEST_CASE("pictures of a periodic box show the remaining walls") {
  const Box box{{0.2, 0.3}};
  PeriodicAxes axes;
  axes[1] = Period{0, 0.3};
  const std::vector<WallPicture> walls = pictures_of(box, 0.5, axes);
  REQUIRE(walls.size() == 2);
  CHECK(walls[1].mesh.triangles.size() == 4);
  for (const auto& [a, b, c] : walls[1].mesh.triangles) {
    const auto& vertices = walls[1].mesh.vertices;
    CHECK(vertices[a][0] == vertices[b][0]);  // across x
    CHECK(vertices[a][0] == vertices[c][0]);
  }
  axes[0] = Period{0, 0.2};
  CHECK(pictures_of(box, 0.5, axes).size() == 1);
}

TEST_CASE("mistakes in a scene with periodic axes are refused with the reason") {
  const std::string text = periodic_text("x = [0, 0.05]\n");
  CHECK(complaint(text).empty());
  check_says(complaint(replaced(text, "x = [0, 0.05]", "x = [0, 0.04]")),
             {"periodic.x is [0, 0.04]; allowed: [0, 0.05] m, from wall to wall"});
  check_says(complaint(replaced(text, "x = [0, 0.05]", "y = [0, 0.01]")),
             {"periodic.y is [0, 0.01]; allowed: the upper end at least"});
  check_says(complaint(replaced(text, "x = [0, 0.05]", "z = [0, 1]")), {"unknown key \"z\" in [periodic]", "allowed: x, y"});
  check_says(complaint(replaced(text, "x = [0, 0.05]\n", "")), {"[periodic] names no axis; allowed: x = [lower, upper]"});
  check_says(complaint(scene_in(kHopperText) + "[periodic]\nx = [0, 0.1]\n"), {"periodic.x in a hopper; allowed:"});
  check_says(
      complaint(scene_in("kind = \"drum\"\ndiameter = 0.1\nlength = 0.1\nsegments = 32\nrpm = 60") + "[periodic]\nx = [0, 0.1]\n"),
      {"periodic.x in a drum; allowed:", "periodic.y in a drum"});

  const std::string open = scene_in(
      "kind = \"none\"\nstart = { corner = [0, 0, 0.01], size = [0.05, 0.06, 0.1] }\n"
      "bounds = { corner = [-1, -1, -1], size = [3, 3, 3] }");
  const std::string cell = "[periodic]\nx = [0, 0.08]\n";
  const auto with_part = [&](const std::string& part) { return complaint(open + cell + "[[part]]\nname = \"wall\"\n" + part); };
  CHECK(with_part("shape = \"plane\"\n").empty());
  CHECK(with_part("shape = \"box\"\nsize = [0.2, 0.1, 0.01]\nposition = [0.04, 0, 0]\n").empty());
  CHECK(with_part("shape = \"cylinder\"\nradius = 0.01\nlength = 0.2\nposition = [0.04, 0, 0]\naxis = [0, 1, 0]\nangle = 90\n"
                  "[[part.motion]]\nkind = \"rotation\"\naxis = [1, 0, 0]\npoint = [0, 0, 0]\nrpm = 10\n")
            .empty());
  CHECK(with_part("shape = \"plane\"\n[[part.motion]]\nkind = \"conveyor\"\nvelocity = [0.1, 0, 0]\n").empty());
  check_says(with_part("shape = \"plane\"\naxis = [0, 1, 0]\nangle = 10\n"),
             {"part \"wall\" is not the same all along x", "the plane is not parallel to the axis"});
  check_says(with_part("shape = \"box\"\nsize = [0.08, 0.1, 0.01]\nposition = [0.04, 0, 0]\n"),
             {"part \"wall\" is not the same all along x", "it reaches from 0 to 0.08 m and must from -0.0"});
  check_says(with_part("shape = \"box\"\nsize = [0.2, 0.1, 0.01]\nposition = [0.04, 0, 0]\naxis = [0, 0, 1]\nangle = 10\n"),
             {"no edge of the box is along the axis"});
  check_says(with_part("shape = \"cylinder\"\nradius = 0.01\nlength = 0.2\n"), {"the cylinder is not along the axis"});
  check_says(with_part("shape = \"ellipsoid\"\nhalf_axes = [1, 1, 1]\n"), {"a smooth body ends"});
  check_says(with_part("shape = \"box\"\nsize = [1, 0.1, 0.01]\n[[part.motion]]\nkind = \"velocity\"\nvelocity = [0.1, 0, 0]\n"),
             {"its velocity takes it along the axis"});
  check_says(with_part("shape = \"plane\"\n[[part.motion]]\nkind = \"rotation\"\naxis = [0, 0, 1]\npoint = [0, 0, 0]\nrpm = 10\n"),
             {"it does not turn about the axis"});
  check_says(complaint(replaced(open, "start = { corner = [0, 0, 0.01]", "start = { corner = [-0.01, 0, 0.01]") + cell +
                       "[[part]]\nname = \"floor\"\nshape = \"plane\"\n"),
             {"periodic.x is [0, 0.08]; allowed: around container.start, which is from -0.01 to"});
  check_says(complaint(text + "[[measurement]]\nkind = \"stress\"\ninterval = 0.01\nlower = [0, 0, 0]\nupper = [0.1, 0.06, 0.1]\n"),
             {"measurement.upper[0] is 0.1; allowed: from 0 to 0.05 m, within the periodic cell"});
  check_says(complaint(text + "[[feeder]]\nname = \"rain\"\ncorner = [0.04, 0, 0.1]\nsize = [0.02, 0.02, 0.02]\n"
                              "grains_per_second = 1\n"),
             {"feeder \"rain\" reaches from 0.04 to 0.06 m along x; allowed: from 0 to 0.05 m"});
}
