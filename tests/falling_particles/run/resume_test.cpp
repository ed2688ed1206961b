// A simulation that goes on from what another one has saved, against one that has not been left.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "advise/refusals.hpp"
#include "base/archive.hpp"
#include "observe/measurement.hpp"
#include "observe/simulation.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

Scene sample(const std::string& name) { return load_scene(std::string(SUPERNORMAL_SAMPLES) + "/scenes/" + name + ".toml"); }

/// From step `from`, exclusive, to step `to`.
void advance(Simulation& simulation, const Scene& scene, int from, int to) {
  for (int step = from + 1; step <= to; ++step) simulation.advance(step * scene.time.step);
}

/// All numbers that a simulation has between two steps, bit for bit; not the times that steps took.
std::string state_of(const Simulation& simulation, const WorldState& world) {
  Writer writer;
  writer(world, simulation.random, simulation.watches, simulation.population, simulation.stepper.deepest_contact(),
         simulation.stepper.costs().contacts, simulation.stepper.costs().pairs_tested);
  const snStatistics statistics = simulation.statistics();
  writer(statistics.queries_cold, statistics.queries_warm, statistics.evaluations_cold, statistics.evaluations_warm);
  for (const supernormal::effects::Cost& cost : simulation.effect_costs()) writer(cost.rows, cost.contacts, cost.bodies);
  return writer.bytes();
}

/// The same, and the contacts of the last step.
std::string results_of(const Simulation& simulation) {
  Writer writer;
  for (const dContactGeom& contact : simulation.stepper.contact_geoms()) writer(contact.depth, contact.pos[0], contact.normal[2]);
  return state_of(simulation, simulation.world.save()) + writer.bytes();
}

constexpr int kEvery = 60;

/// The end of a run that saves itself after kEvery steps and twice that, and goes on from there; with what it has saved last.
std::string end_of_run(const Scene& scene, int end, std::string& saved) {
  std::optional<Simulation> simulation(std::in_place, scene, 1);
  int step = 0;
  for (int k = 0; k < 2; ++k, step += kEvery) {
    advance(*simulation, scene, step, step + kEvery);
    saved = simulation->save();
    simulation.reset();
    simulation.emplace(scene, 1, saved);
  }
  advance(*simulation, scene, step, end);
  return results_of(*simulation);
}

/// The attitudes of a world, taken out of it: ODE scales quaternions to 1 when they are set, which may change a last digit.
std::vector<double> take_attitudes(WorldState& world) {
  std::vector<double> attitudes;
  for (SavedGrain& grain : world.grains) {
    attitudes.insert(attitudes.end(), grain.quaternion.begin(), grain.quaternion.end());
    grain.quaternion = {};
  }
  return attitudes;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

std::vector<double> places_in(const World& world) {
  std::vector<double> places;
  for (const Grain& grain : world.present()) {
    for (const double x : world.place_of(grain)) places.push_back(x);
  }
  return places;
}

/// Checks that nothing is lost on the way: the state is the same, and the next step leads to where it would have led, but for what
/// the order of contacts changes in the solver's answer.
void check_nothing_is_lost(const Scene& scene) {
  std::optional<Simulation> simulation(std::in_place, scene, 1);
  advance(*simulation, scene, 0, 2 * kEvery);
  const std::string saved = simulation->save();
  WorldState world = simulation->world.save();
  const std::vector<double> attitudes = take_attitudes(world);
  const std::string state = state_of(*simulation, world);
  advance(*simulation, scene, 2 * kEvery, 2 * kEvery + 1);
  const std::vector<double> places = places_in(simulation->world);
  simulation.reset();

  Simulation resumed(scene, 1, saved);
  world = resumed.world.save();
  CHECK(largest_difference(take_attitudes(world), attitudes) < 1e-15);
  CHECK(state_of(resumed, world) == state);
  advance(resumed, scene, 2 * kEvery, 2 * kEvery + 1);
  CHECK(largest_difference(places_in(resumed.world), places) < 1e-4 * scene.smallest_half_axis());
}

/// Checks that a run that was left at its second checkpoint ends as one that was not, with another number of threads, too.
void check_same_end(const Scene& scene, int end) {
  std::string saved;
  const std::string expected = end_of_run(scene, end, saved);
  Simulation resumed(scene, 2, saved);
  advance(resumed, scene, 2 * kEvery, end);
  CHECK(resumed.stepper.contacts() > 0);
  CHECK(results_of(resumed) == expected);
}

void check_resume(const Scene& scene, int end = 5 * kEvery / 2) {
  check_nothing_is_lost(scene);
  check_same_end(scene, end);
}

std::string table_of(const Simulation& simulation, double time) {
  const auto measurement = find_measurement_kind("final_state")->on_by_default->make(simulation.world);
  TableText table;
  measurement->measure({time, simulation.world, {}, &simulation}, table);
  return measurement->columns() + '\n' + table.text();
}

/// The largest difference of a member of two worlds' grains.
template <std::size_t size>
double difference(const WorldState& a, const WorldState& b, std::array<double, size> SavedGrain::*member) {
  REQUIRE(a.grains.size() == b.grains.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.grains.size(); ++i) {
    for (std::size_t k = 0; k < size; ++k) {
      largest = std::max(largest, std::abs((a.grains[i].*member)[k] - (b.grains[i].*member)[k]));
    }
  }
  return largest;
}

/// Checks that the state of a run, written and read, is the same, and that the next step leads to the same places but for the order
/// of the solver's rows.
void check_goes_on(const std::string& name, std::vector<std::string> overrides, int steps) {
  const std::string path = std::string(SUPERNORMAL_SAMPLES) + "/scenes/" + name + ".toml";
  overrides.emplace_back("solver.iterations=400");  // with fewer, the answer depends on the order of the rows
  const TemporaryFolder folder;
  WorldState end, next;
  {
    const Scene scene = load_scene(path, overrides);
    Simulation simulation(scene, 1);
    advance(simulation, scene, 0, steps);
    folder.write("state.csv", table_of(simulation, 1));
    end = simulation.world.save();
    advance(simulation, scene, 0, 1);
    next = simulation.world.save();
  }
  std::vector<std::string> from_state = overrides;
  from_state.push_back("start.file=\"" + (folder.path() / "state.csv").string() + '"');
  const Scene scene = load_scene(path, from_state);
  CHECK_NOTHROW(refuse_bad_start(scene));
  Simulation simulation(scene, 1);
  const WorldState start = simulation.world.save();
  for (std::size_t i = 0; i < start.grains.size(); ++i) {
    CHECK(start.grains[i].kind == end.grains[i].kind);
    CHECK(start.grains[i].scale == end.grains[i].scale);
    CHECK(start.grains[i].mass == end.grains[i].mass);
  }
  CHECK(difference(start, end, &SavedGrain::position) == 0);
  CHECK(difference(start, end, &SavedGrain::velocity) == 0);
  CHECK(difference(start, end, &SavedGrain::angular_velocity) == 0);
  CHECK(difference(start, end, &SavedGrain::quaternion) < 1e-15);  // ODE scales quaternions to 1 when they are set
  advance(simulation, scene, 0, 1);
  CHECK(difference(simulation.world.save(), next, &SavedGrain::position) < 1e-4 * scene.smallest_half_axis());
}

}  // namespace

TEST_CASE("resume: grains that come from a feeder, some of which have gone into a sink, on a belt") {
  Scene scene = sample("feeder");
  scene.feeders[0].rate.number = 0.2;  // kg/s
  scene.sinks.push_back({"hole", Region{{0, 0, 0.1}, {0.05, 0.03, 0.03}}});
  std::string saved;
  end_of_run(scene, 3 * kEvery, saved);
  const Simulation simulation(scene, 1, saved);
  CHECK(simulation.population.fed().grains > 10);
  CHECK(simulation.population.taken().grains > 0);
  check_resume(scene, 3 * kEvery);
}

TEST_CASE("resume: the contact forces that the stepper remembers, of grains that come and go") {
  Scene scene = sample("feeder");
  scene.feeders[0].rate.number = 0.2;  // kg/s
  scene.sinks.push_back({"hole", Region{{0, 0, 0.1}, {0.05, 0.03, 0.03}}});
  scene.solver = {.stepper = Accuracy{}};
  check_resume(scene, 3 * kEvery);
}

TEST_CASE("resume: a run of quickstep goes on with the stepper, and with quickstep again") {
  Scene scene = sample("feeder");
  std::string saved;
  for (const auto& stepper : {std::optional<Accuracy>(), std::optional(Accuracy{}), std::optional<Accuracy>()}) {
    scene.solver.stepper = stepper;
    std::optional<Simulation> simulation;
    saved.empty() ? simulation.emplace(scene, 1) : simulation.emplace(scene, 1, saved);
    CHECK_NOTHROW(advance(*simulation, scene, 0, kEvery));
    saved = simulation->save();
  }
}

TEST_CASE("resume: images in a periodic drum that turns") {
  Scene scene = sample("drum_periodic");
  for (Wall& wall : scene.walls) {
    for (WallMotion& motion : wall.motions) motion.from = 0.02;  // s
  }
  check_resume(scene);
}

TEST_CASE("resume: contacts before overlap, of grains that come from a feeder, bounce and go through a periodic boundary") {
  Scene scene = sample("feeder");
  scene.feeders[0].rate.number = 0.2;  // kg/s
  scene.periodic[1] = Period{0, 0.06};
  scene.time.step = 2e-3;
  scene.effects.emplace_back(supernormal::effects::Restitution{0.5, 0, {}});
  scene.effects.emplace_back(supernormal::effects::SpeculativeContacts{});
  check_same_end(scene, 3 * kEvery);  // which of two impacts of a grain comes first is up to the order of contacts
  std::string saved;
  end_of_run(scene, 3 * kEvery, saved);
  const std::vector<supernormal::effects::Cost> costs = Simulation(scene, 1, saved).effect_costs();
  CHECK(costs.back().name == std::string("speculative_contacts"));
  CHECK(costs.back().contacts > 100);
}

TEST_CASE("resume: a door under a power, and a servo on its way") {
  Scene scene = sample("piston");
  Drive& servo = *scene.walls.back().drive;
  servo = {servo.axis, 0, 0};
  servo.servo = Servo{2000, 1e-4, 0.5, 0, {{"x_low", "x_high"}, {"y_low", "y_high"}}};
  Wall& door = scene.walls.emplace_back(Wall{"door", BoxShape{{0.06, 0.01, 0.06}}, {{0.04, 0.04, 0.1}}});
  door.drive = Drive{Vector3::UnitZ(), 1, 1e-4};
  door.drive->power = 0.1;
  door.drive->point = Vector3(0.04, 0.04, 0);
  door.drive->hung_mass = 0.1;
  check_resume(scene);
}

TEST_CASE("resume: a hopper, before and after its outlet opens") {
  Scene scene = sample("hopper");
  for (GrainCount& kind : scene.kinds) kind.count /= 4;
  for (const double opens_at : {0.05, 0.001}) {
    std::get<Hopper>(scene.container).opens_at = opens_at;
    check_resume(scene);
  }
}

TEST_CASE("resume: grains on a terrain") {
  Scene scene = sample("terrain");
  scene.drop.height = 0;
  check_resume(scene, 250);
}

TEST_CASE("resume: compounds and grains of many sizes") {
  check_resume(sample("compounds"));
  check_resume(sample("sizes"));
}

TEST_CASE("resume: grains that start from a state") {
  Scene scene = sample("short");
  StartState start{.has_velocities = true, .overlap = 1};
  {
    Simulation before(scene, 1);
    advance(before, scene, 0, 200);
    for (const SavedGrain& grain : before.world.save().grains) {
      start.grains.push_back({grain.kind, grain.scale, grain.position, grain.quaternion, grain.velocity, grain.angular_velocity});
    }
  }
  scene.start = start;
  check_resume(scene);
}

TEST_CASE("resume: grains that sleep") {
  Scene scene = sample("short");
  scene.effects.emplace_back(supernormal::effects::AutoDisable{1, 100, 0, 5});  // all fall asleep as soon as they lie
  std::string saved;
  const std::string expected = end_of_run(scene, 500, saved);
  Simulation resumed(scene, 1, saved);
  advance(resumed, scene, 2 * kEvery, 500);
  int asleep = 0;
  for (const Grain& grain : resumed.world.present()) asleep += 1 - dBodyIsEnabled(grain.body);
  CHECK(asleep > 0);
  CHECK(results_of(resumed) == expected);
  const std::string at_rest = resumed.save();
  const Simulation later(scene, 1, at_rest);
  for (const Grain& grain : later.world.present()) asleep -= 1 - dBodyIsEnabled(grain.body);
  CHECK(asleep == 0);
}

TEST_CASE("resume: a state that ends too early is refused") {
  const Scene scene = sample("short");
  const std::string saved = Simulation(scene, 1).save();
  CHECK_THROWS(Simulation(scene, 1, saved.substr(0, saved.size() - 1)));
}

TEST_CASE("start: a state that is written and read goes on as the run would") {
  check_goes_on("short", {}, 400);
  check_goes_on("sizes", {"grain[soybean].count=20", "grain[river_pebble].count=20", "grain[lentil].count=20"}, 600);
  check_goes_on("compounds", {"grain[jack].count=5"}, 900);
}
