// Scenes that the stepper moves in place of quickstep, against closed forms.
#include "world/stepper.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "advise/doubts.hpp"
#include "common/random.hpp"
#include "observe/energy.hpp"
#include "observe/simulation.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/placement.hpp"
#include "world/world.hpp"

using namespace falling_particles;
using supernormal::test::relative;
namespace fx = supernormal::effects;

namespace {

constexpr double kEarth = 9.81;  // m/s^2

GrainKind slab() { return {"slab", {0.05, 0.035, 0.025}, 20, 20, 0, 1000, "test"}; }

Scene with_stepper(std::vector<Wall> walls, const GrainKind& kind, double step) {
  Scene scene = scene_of(Open{{{-1, -1, 0}, {2, 2, 1}}, {{-9, -9, -9}, {18, 18, 18}}}, {{kind, 1}});
  scene.walls = std::move(walls);
  scene.effects = {fx::Gravity{{0, 0, -kEarth}}, fx::Friction{0.4, {}}};
  scene.time.step = step;
  scene.solver = {.stepper = Accuracy{}};
  return scene;
}

Wall floor_of(const WallShape& shape, const Vector3& position = Vector3::Zero(), std::vector<WallMotion> motions = {}) {
  return {"floor", shape, {position, Eigen::Quaterniond::Identity()}, std::move(motions)};
}

Placement place_at(const Point& position, const Point& velocity = {}) { return {0, position, {1, 0, 0, 0}, 1, velocity}; }

void advance(Stepper& stepper, const Scene& scene, double time) {
  for (int k = 0; (k + 0.5) * scene.time.step < time; ++k) stepper.step();
}

const dReal* first_velocity(const World& world) { return dBodyGetLinearVel(world.grains()[0].body); }

/// What the loader says of the scene with the stepper, and more.
std::string complaint_of_stepper(const std::string& also, const std::string& solver = "",
                                 const std::vector<std::string>& overrides = {}) {
  return complaint(replaced(kSceneText, "iterations = 20\nerp = 0.2\ncfm = 1e-10", "kind = \"stepper\"\n" + solver) + also,
                   kCatalogueText, overrides);
}

using Pairs = std::set<std::pair<dGeomID, dGeomID>>;

void insert(void* pairs, dGeomID g1, dGeomID g2) { static_cast<Pairs*>(pairs)->insert(std::minmax(g1, g2)); }

Pairs named_pairs(const World& world) {
  Pairs pairs;
  world.name_pairs(&pairs, insert);
  return pairs;
}

bool boxes_meet(dGeomID g1, dGeomID g2) {
  dReal box1[6];
  dReal box2[6];
  dGeomGetAABB(g1, box1);
  dGeomGetAABB(g2, box2);
  for (int axis = 0; axis < 3; ++axis) {
    if (box1[2 * axis] > box2[2 * axis + 1] || box2[2 * axis] > box1[2 * axis + 1]) return false;
  }
  return true;
}

Pairs all_pairs(const World& world) {
  std::vector<dGeomID> geoms = world.walls().geoms();
  const std::size_t walls = geoms.size();
  for (const Grain& grain : world.grains()) geoms.push_back(grain.geom);
  Pairs pairs;
  for (std::size_t i = walls; i < geoms.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (boxes_meet(geoms[i], geoms[j])) pairs.insert(std::minmax(geoms[i], geoms[j]));
    }
  }
  return pairs;
}

Scene scene_of_peas(int count) { return scene_of(replaced(kSceneText, "count = 5", "count = " + std::to_string(count))); }

/// A world with the same grains in the same places.
World make_world(const Scene& scene) {
  Random random(1);
  return World(scene, place(scene, random));
}

/// Scatters grains in a box of these sides above the floor, close enough to meet.
void scatter(const World& world, const Point& sides) {
  Random random(2);
  for (const Grain& grain : world.grains()) {
    const double x = sides[0] * random.uniform();
    const double y = sides[1] * random.uniform();
    dBodySetPosition(grain.body, x, y, sides[2] * random.uniform());
  }
}

}  // namespace

TEST_CASE("stepper: a brick slides as far in all directions as Coulomb's law says") {
  for (const double angle : {0.0, 0.3, std::numbers::pi / 4}) {
    CAPTURE(angle);
    const Scene scene = with_stepper({floor_of(PlaneShape{})}, slab(), 5e-3);
    const World world(scene, {place_at({0, 0, 0.025}, {std::cos(angle), std::sin(angle), 0})});
    Stepper stepper(world, scene);
    advance(stepper, scene, 0.5);
    const Point place = world.grains()[0].position();
    CHECK(std::hypot(place[0], place[1]) == relative(1 / (2 * 0.4 * kEarth)).epsilon(1e-2));
    CHECK(std::abs(std::atan2(place[1], place[0]) - angle) < 1e-3);
    CHECK(std::abs(first_velocity(world)[0]) < 1e-9);
  }
}

TEST_CASE("stepper: a ball that slides rolls in the end, and rolling resistance brings it to rest") {
  Scene scene = with_stepper({floor_of(PlaneShape{})}, ball(), 5e-3);
  for (const double resistance : {0.0, 1e-4}) {
    CAPTURE(resistance);
    if (resistance > 0) scene.effects.emplace_back(fx::RollingResistance{resistance, 0, {}});
    const World world(scene, {place_at({0, 0, 5e-3}, {1, 0, 0})});
    Stepper stepper(world, scene);
    advance(stepper, scene, 0.5);
    const double taken = resistance * kEarth * 0.5 / 5e-3;  // m/s; of the angular momentum about the contact over mass and radius
    CHECK(first_velocity(world)[0] == relative(5.0 / 7 * (1 - taken)).epsilon(1e-3));
  }
}

TEST_CASE("stepper: a ball leaves a wall that comes with the restitution times its approach velocity") {
  Scene scene = with_stepper({floor_of(PlaneShape{}, {0, 0, 0}, {{Translation{{0, 0, 2}}}})}, ball(), 0.01);
  scene.effects = {fx::Restitution{0.8, 0, {}}};
  const World world(scene, {place_at({0, 0, 0.1}, {0, 0, -3})});
  Stepper stepper(world, scene);
  advance(stepper, scene, 0.1);
  CHECK(first_velocity(world)[2] == relative(2 + 0.8 * 5).epsilon(1e-9));
  CHECK(stepper.costs().parts > 10);  // a step ended early
}

TEST_CASE("stepper: grains keep to a floor that rises, and ride on one that turns") {
  const std::vector<WallShape> shapes = {PlaneShape{}, BoxShape{{2, 2, 0.1}}};
  for (const WallShape& shape : shapes) {
    const double top = std::holds_alternative<PlaneShape>(shape) ? 0 : 0.05;
    for (const GrainKind& kind : {ball(), slab()}) {
      CAPTURE(top);
      CAPTURE(kind.name);
      const double half = kind.half_axes[2];
      const Scene rising = with_stepper({floor_of(shape, {0, 0, 0}, {{Translation{{0, 0, 0.5}}}})}, kind, 0.01);
      const World up(rising, {place_at({0, 0, top + half}, {0, 0, 0.5})});
      Stepper rises(up, rising);
      advance(rises, rising, 0.5);
      // Look-ahead takes the floor for one that stands, so grains fall for a step at times.
      CHECK(std::abs(up.grains()[0].position()[2] - (top + half + 0.25)) < kEarth * 1e-4);

      const Scene turning = with_stepper({floor_of(shape, {0, 0, 0}, {{Rotation{{0, 0, 1}, {0, 0, 0}, 60}}})}, kind, 0.01);
      if (kind.name == "ball") continue;  // it rolls
      const double speed = 0.06 * 2 * std::numbers::pi;
      Placement place = place_at({0.06, 0, top + half}, {0, speed, 0});
      place.angular_velocity = {0, 0, 2 * std::numbers::pi};
      const World around(turning, {place});
      Stepper turns(around, turning);
      advance(turns, turning, 1);
      const double tangents = std::pow(2 * std::numbers::pi, 2) * turning.time.step / 8 / 2;  // of sub-steps would lead outwards
      CHECK(around.grains()[0].position()[0] == relative(0.06).epsilon(0.1 * tangents));
      CHECK(std::abs(around.grains()[0].position()[1]) < 2e-3 * 0.06);
    }
  }
}

TEST_CASE("stepper: measured forces carry the weight of a pile on all walls") {
  Scene scene = scene_of(kSceneText);
  scene.solver = {.stepper = Accuracy{}};
  scene.time.step = 4e-3;
  Simulation simulation(scene, 1);
  double weight = 0, carried = 0;
  for (const Grain& grain : simulation.world.grains()) weight += kEarth * grain.mass.mass;
  for (int k = 0; k < 300; ++k) simulation.stepper.step(k >= 250);
  for (const MeasuredContact& contact : simulation.stepper.measured_contacts()) {
    if ((grain_of(contact.geom.g1) == nullptr) == (grain_of(contact.geom.g2) == nullptr)) continue;  // between grains
    carried += (grain_of(contact.geom.g1) == nullptr ? -1 : 1) * contact.force()[2];
  }
  CHECK(carried == relative(weight).epsilon(1e-3));
}

TEST_CASE("stepper: the force of an impact is measured in all parts of its step") {
  Scene scene = with_stepper({floor_of(PlaneShape{})}, ball(), 0.01);
  scene.effects = {fx::Restitution{1, 0, {}}};
  const World world(scene, {place_at({0, 0, 0.02}, {0, 0, -3})});
  Stepper stepper(world, scene);
  double impulse = 0;
  for (int k = 0; k < 5; ++k) {
    stepper.step(true);
    for (const MeasuredContact& contact : stepper.measured_contacts()) impulse += scene.time.step * std::abs(contact.force()[2]);
  }
  CHECK(impulse == relative(6 * world.grains()[0].mass.mass).epsilon(1e-9));
}

TEST_CASE("stepper: a part that is free falls, rests on the floor and carries a grain") {
  Wall plate = floor_of(BoxShape{{0.2, 0.2, 0.02}}, {0, 0, 0.1});
  plate.name = "plate";
  plate.flight = Flight{.mass = 1, .inertia = Eigen::Vector3d(0.0034, 0.0034, 0.0067).asDiagonal()};
  const Scene scene = with_stepper({floor_of(PlaneShape{}), plate}, ball(), 5e-3);
  const World world(scene, {place_at({0, 0, 0.11 + 5e-3})});
  Stepper stepper(world, scene);
  advance(stepper, scene, 0.1);
  CHECK(world.walls().state(1).pose.position.z() == relative(0.1 - 0.5 * kEarth * 0.01).epsilon(1e-3));
  advance(stepper, scene, 0.9);
  CHECK(world.walls().state(1).pose.position.z() == relative(0.01).epsilon(0.01));
  CHECK(world.grains()[0].position()[2] == relative(0.025).epsilon(0.01));
}

TEST_CASE("stepper: a free part that turns about no principal axis keeps its energy") {
  Wall plate = floor_of(BoxShape{{0.2, 0.1, 0.02}}, {0, 0, 1});
  plate.flight = Flight{.mass = 1, .inertia = Eigen::Vector3d(1, 4, 5).asDiagonal(), .velocity = {{0.5, 0, 0}, {3, 2, 1}}};
  Scene scene = with_stepper({plate}, ball(), 5e-3);
  scene.effects.clear();
  const World world(scene, {place_at({1, 1, 1})});
  Stepper stepper(world, scene);
  const auto energy = [&] {
    const Eigen::Quaterniond& turn = world.walls().state(0).pose.rotation;
    const Vector3& momentum = world.walls().flying(0)->momentum;
    const Vector3 in_body = turn.conjugate() * momentum;
    return in_body.cwiseQuotient(Vector3(1, 4, 5)).dot(in_body);
  };
  const double before = energy();
  advance(stepper, scene, 2);
  CHECK(energy() == relative(before).epsilon(1e-3));
  CHECK(world.walls().state(0).pose.position.x() == relative(1).epsilon(1e-9));
}

TEST_CASE("stepper: grains that sleep wake where something hits them") {
  Scene scene = with_stepper({floor_of(PlaneShape{})}, slab(), 0.01);
  scene.effects.emplace_back(fx::AutoDisable{0.01, 0.1, 0.1, 10});
  scene.kinds = {{slab(), 2}};
  const World world(scene, {place_at({0, 0, 0.025}), place_at({0, 0, 0.075 + 1})});
  Stepper stepper(world, scene);
  advance(stepper, scene, 0.4);
  CHECK(dBodyIsEnabled(world.grains()[0].body) == 0);
  advance(stepper, scene, 0.1);
  CHECK(dBodyIsEnabled(world.grains()[0].body) != 0);
  advance(stepper, scene, 2);
  CHECK(dBodyIsEnabled(world.grains()[0].body) == 0);
  CHECK(dBodyIsEnabled(world.grains()[1].body) == 0);
}

TEST_CASE("stepper: a hopper that is fed and drained runs, with the same digits twice") {
  const std::string text = replaced(replaced(scene_in(kHopperText), "opens_at = 0.05", "opens_at = 0.02"),
                                    "iterations = 20\nerp = 0.2\ncfm = 1e-10", "kind = \"stepper\"\nsub_steps = [4, 32]") +
                           "[[feeder]]\nname = \"spout\"\ncorner = [-0.03, -0.03, 0.2]\nsize = [0.06, 0.06, 0.03]\n"
                           "grains_per_second = 100\nvelocity = [0, 0, -1]\n"
                           "[[sink]]\nname = \"drain\"\npoint = [0, 0, 0.03]\nnormal = [0, 0, 1]\n";
  const Scene scene = scene_of(replaced(replaced(text, "step = 0.0005", "step = 0.002"), "duration = 0.1", "duration = 0.5"));
  CHECK(scene.solver.stepper->most == 32);
  std::vector<std::vector<Point>> ends;
  for (int k = 0; k < 2; ++k) {
    Simulation simulation(scene, k + 1);
    for (int step = 1; step <= 250; ++step) simulation.advance(step * scene.time.step);
    CHECK(simulation.population.fed().grains > 40);
    CHECK(simulation.population.taken().grains > 20);
    CHECK(simulation.watches.leaks.count() == 0);
    ends.emplace_back();
    for (const Grain& grain : simulation.world.present()) ends.back().push_back(grain.position());
  }
  CHECK(ends[0] == ends[1]);
}

TEST_CASE("stepper: what it cannot do is refused by its name, with what is allowed") {
  CHECK(complaint_of_stepper("").empty());
  CHECK(complaint_of_stepper("[restitution]\ncoefficient = 0.5\n[rolling_resistance]\nrolling = 1e-5\n", "sag = 1e-3\n").empty());
  check_says(complaint_of_stepper("", "iterations = 20\n"),
             {"scene.toml:21: solver.iterations is given with solver.kind = \"stepper\"", "sag, sub_steps"});
  check_says(complaint(replaced(kSceneText, "erp = 0.2", "erp = 0.2\nsag = 1e-3")),
             {"scene.toml:22: solver.sag is given with solver.kind = \"quickstep\"", "iterations, erp, cfm"});
  check_says(complaint(replaced(kSceneText, "erp = 0.2", "erp = 0.2\nkind = \"newton\"")),
             {"solver.kind is \"newton\"", "quickstep, stepper"});
  check_says(complaint_of_stepper("", "sag = 0\n"), {"solver.sag is 0", "[1e-12, 1]"});
  check_says(complaint_of_stepper("", "sub_steps = [9, 8]\n"), {"solver.sub_steps is [9, 8]", "two whole numbers"});
  check_says(complaint_of_stepper("", "sub_steps = [1.5, 8]\n"), {"solver.sub_steps is [1.5, 8]", "two whole numbers"});
  check_says(
      complaint_of_stepper("[hertz]\nyoungs_modulus = 1e7\npoisson_ratio = 0.3\n", "", {"max_correcting_velocity.enabled=false"}),
      {"hertz is listed for a stepper", "quickstep"});
  check_says(complaint_of_stepper("[adhesion]\npull_off = 1e-3\n"), {"adhesion is listed for a stepper", "quickstep"});
  check_says(complaint_of_stepper("[speculative_contacts]\n"), {"speculative_contacts is listed for a stepper", "look ahead"});
  check_says(complaint_of_stepper("[[bond]]\nname = \"glue\"\nkind = \"ball\"\ntouching = 0.5\nmodulus = 1e6\n"),
             {"solver.kind is \"stepper\"", "[[bond]]", "allowed: \"quickstep\""});
  check_says(complaint_of_stepper("[periodic]\nx = [0, 0.05]\n"), {"solver.kind is \"stepper\"", "periodic axes"});
  check_says(complaint_of_stepper("[[part]]\nname = \"lid\"\nshape = \"plane\"\nposition = [0, 0, 0.5]\n"
                                  "[part.drive]\naxis = [0, 0, 1]\nforce = 1\nmass = 1\n"),
             {"solver.kind is \"stepper\"", "a drive, of part \"lid\""});
}

TEST_CASE("stepper: there are no doubts about what only quickstep does not hold") {
  Scene scene = scene_of(kSceneText, {"solver.iterations=1"});
  scene.kinds[1].kind.density *= 100;
  CHECK_FALSE(doubts_about(scene).empty());
  scene.solver = {.stepper = Accuracy{}};
  CHECK(doubts_about(scene).empty());
}

TEST_CASE("the sweep is along the axis of the largest spread, also after it changes, and names every pair whose boxes meet") {
  const Scene scene = scene_of_peas(200);
  const World world = make_world(scene);
  struct Bed {
    Point sides;
    Axis axis;
  };
  const std::vector<Bed> beds = {
      {{0.01, 0.01, 1}, Axis::Z}, {{1, 0.1, 0.1}, Axis::X}, {{0.1, 1, 0.1}, Axis::Y}, {{1, 1.1, 0.1}, Axis::Y}};
  for (const Bed& bed : beds) {
    CAPTURE(name_of(bed.axis));
    scatter(world, bed.sides);
    for (int step = 0; step < 100; ++step) world.sweep().before_step();
    CHECK(world.sweep().axis() == bed.axis);
    scatter(world, {0.05, 0.06, 0.03});
    const Pairs pairs = named_pairs(world);
    CHECK(pairs.size() > 300);
    CHECK(pairs == all_pairs(world));
  }
}

TEST_CASE("a broad phase that finds no pairs is timed") {
  const Scene scene = scene_of_peas(5000);
  const World world = make_world(scene);
  Stepper stepper(world, scene);
  for (int step = 0; step < 5; ++step) stepper.step();
  const StepCosts& costs = stepper.costs();
  CHECK(costs.pairs_tested == 0);
  CHECK(costs.broad_phase.seconds() > 0.5 * costs.collision.seconds());
}
