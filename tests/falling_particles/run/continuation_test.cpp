// A run that starts from the state of another one.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "advise/refusals.hpp"
#include "observe/measurement.hpp"
#include "observe/simulation.hpp"
#include "observe/table_text.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

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
  advance_by(simulation, scene, 1);
  CHECK(difference(simulation.world.save(), next, &SavedGrain::position) < 1e-4 * scene.smallest_half_axis());
}

}  // namespace

TEST_CASE("start: a state that is written and read goes on as the run would") {
  check_goes_on("short", {}, 400);
  check_goes_on("sizes", {"grain[soybean].count=20", "grain[river_pebble].count=20", "grain[lentil].count=20"}, 600);
  check_goes_on("compounds", {"grain[jack].count=5"}, 900);
}
