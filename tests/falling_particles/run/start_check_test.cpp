// Scenes that start from a state: what is refused, and how they go on.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "complaint.hpp"
#include "observe/measurement.hpp"
#include "observe/simulation.hpp"
#include "observe/table_text.hpp"
#include "run/doubts.hpp"
#include "run/forecast.hpp"
#include "scene_text.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

constexpr const char* kHead = "grain,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s\n";

/// The scene of scene_text.hpp, 0.05 m by 0.06 m, with peas of 3 mm from a state.
Scene with_state(const TemporaryFolder& folder, const std::string& grains, std::vector<std::string> overrides = {}) {
  folder.write("grains.toml", kCatalogueText);
  folder.write("state.csv", kHead + grains);
  overrides.emplace_back("start.file=\"state.csv\"");
  return load_scene(folder.write("scene.toml", kSceneText), overrides);
}

std::string refusal_of_start(const std::string& grains, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  const Scene scene = with_state(folder, grains, overrides);
  try {
    refuse_overlapping_start(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string pea_at(double x, double y, double z) {
  return "pea," + shortest(x) + ',' + shortest(y) + ',' + shortest(z) + ",1,0,0,0,0,0,0\n";
}

std::string table_of(const Simulation& simulation, double time) {
  const auto measurement = find_measurement_kind("final_state")->on_by_default->make(simulation.world);
  TableText table;
  measurement->measure({time, simulation.world, {}, &simulation}, table);
  return measurement->columns() + '\n' + table.text();
}

void advance_by(Simulation& simulation, const Scene& scene, int steps) {
  for (int step = 1; step <= steps; ++step) {
    simulation.stepper.step();
    simulation.watches.after_step(step * scene.time.step, simulation.stepper);
  }
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
    advance_by(simulation, scene, steps);
    folder.write("state.csv", table_of(simulation, 1));
    end = simulation.world.save();
    advance_by(simulation, scene, 1);
    next = simulation.world.save();
  }
  std::vector<std::string> from_state = overrides;
  from_state.push_back("start.file=\"" + (folder.path() / "state.csv").string() + '"');
  const Scene scene = load_scene(path, from_state);
  CHECK_NOTHROW(refuse_overlapping_start(scene));
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
  advance_by(simulation, scene, 1);
  CHECK(difference(simulation.world.save(), next, &SavedGrain::position) < 1e-4 * scene.smallest_half_axis());
}

}  // namespace

TEST_CASE("start: a state that is written and read goes on as the run would") {
  check_goes_on("short", {}, 400);
  check_goes_on("sizes", {"grain[soybean].count=20", "grain[river_pebble].count=20", "grain[lentil].count=20"}, 600);
  check_goes_on("compounds", {"grain[jack].count=5"}, 900);
}

TEST_CASE("start: grains that overlap too deeply are refused with the pair and its depth") {
  const std::string two = pea_at(0.02, 0.03, 0.01) + pea_at(0.02, 0.0358, 0.01);  // 0.2 mm deep, of 3 mm
  CHECK(refusal_of_start(two).empty());
  const std::string deep = pea_at(0.02, 0.03, 0.01) + pea_at(0.02, 0.035, 0.01);
  check_says(refusal_of_start(deep), {"state.csv:", "the pea is 0.001 m deep in the pea of line", "0.333 of the smallest half-axis",
                                      "allowed: up to 0.1, start.overlap"});
  CHECK(refusal_of_start(deep, {"start.overlap=0.34"}).empty());
  check_says(refusal_of_start(two, {"start.overlap=0.06"}), {"allowed: up to 0.06, start.overlap"});
}

TEST_CASE("start: overlaps across a periodic boundary count") {
  const std::string two = pea_at(1e-3, 0.03, 0.01) + pea_at(0.048, 0.03, 0.01);
  CHECK(!refusal_of_start(two).empty());  // beyond a wall
  check_says(refusal_of_start(two, {"periodic.x=[0, 0.05]"}), {"the pea is 0.003 m deep in the pea of line"});
  CHECK(refusal_of_start(two, {"periodic.x=[0, 0.05]", "grain[pea].count=2", "start.overlap=1"}).empty());
}

TEST_CASE("start: grains beyond a wall are refused by its name") {
  check_says(refusal_of_start(pea_at(0.02, 0.03, 0.01) + pea_at(0.02, 0.03, 2e-3)),
             {"state.csv:3: the pea is 0.001 m deep in wall \"floor\""});
  check_says(refusal_of_start(pea_at(0.06, 0.03, 0.01)), {"state.csv:2: the pea is 0.013 m deep in wall \"x_high\""});
  const std::string part = R"(part=[{name = "block", shape = "box", size = [0.01, 0.01, 0.01], position = [0.02, 0.03, 0.01]}])";
  check_says(refusal_of_start(pea_at(0.02, 0.03, 0.016), {part}), {"the pea is 0.002 m deep in part \"block\""});
  CHECK(refusal_of_start(pea_at(0.02, 0.03, 0.0179), {part}).empty());
}

TEST_CASE("start: a grain outside a container without walls there is refused") {
  const std::string open =
      "container={kind = \"none\", start = {corner = [0, 0, 0], size = [0.1, 0.1, 0.1]}, bounds = {corner = [0, 0, 0], size = [1, "
      "1, 1]}}";
  const std::string part = R"(part=[{name = "block", shape = "box", size = [0.01, 0.01, 0.01], position = [0.02, 0.03, 0.01]}])";
  check_says(refusal_of_start(pea_at(0.5, 0.5, 0.5) + pea_at(0.5, 0.5, 1.5), {open, part}),
             {"state.csv:3: the pea is at [0.5, 0.5, 1.5] m, outside the container, a none; allowed: inside"});
}

TEST_CASE("start: --check says where the grains come from, and doubts fast ones") {
  const TemporaryFolder folder;
  const Scene scene = with_state(folder, "pea,0.02,0.03,0.01,1,0,0,0,0,0,-8\n");
  CHECK(describe(scene, forecast(scene)).find("start         from state.csv; the fastest grain has 8 m/s") != std::string::npos);
  const std::vector<std::string> doubts = doubts_about(scene);
  const auto is_about_speed = [](const std::string& doubt) {
    return doubt.find("the fastest grain of start.file moves 0.004 m") == 0;
  };
  CHECK(std::ranges::count_if(doubts, is_about_speed) == 1);
  CHECK(!fall_from_start(scene).has_value());
}
