// Tables: the measurements that are on by default.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "common/read_file.hpp"
#include "measured.hpp"
#include "observe/measuring.hpp"
#include "observe/simulation.hpp"
#include "output/picture.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;
namespace fs = std::filesystem;

namespace {

/// The tables of the first steps of a run, and their texts.
std::map<std::string, std::string> tables_after(const Scene& scene, int steps, std::vector<MeasurementCost>& costs) {
  const TemporaryFolder parent;
  const OutputFolder folder(parent.path(), "tables", result_names());
  Simulation simulation(scene, 1);
  Measuring measuring(scene, simulation, folder);
  for (int step = 0; step <= steps; ++step) {
    const double time = step * scene.time.step;
    const bool is_frame = step % scene.time.steps_per_frame() == 0;
    if (step > 0) simulation.stepper.step(measuring.wants_forces(step, is_frame));
    measuring.after_step(step, time, is_frame);
    if (step > 0) simulation.watches.after_step(time, simulation.stepper);
    measuring.after_watches(step, time, is_frame);
  }
  measuring.finish(steps * scene.time.step);
  costs = measuring.costs();
  std::map<std::string, std::string> tables;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.file(""))) {
    if (entry.path().extension() == ".csv") {
      tables[fs::relative(entry.path(), folder.file("")).string()] = read_file(entry.path());
    }
  }
  return tables;
}

std::ptrdiff_t lines_of(const std::string& text) { return std::ranges::count(text, '\n'); }

}  // namespace

TEST_CASE("tables: a run has those that are on by default, with a sample in each frame") {
  const Scene scene = scene_with("kind = \"fabric\"\n");
  std::vector<MeasurementCost> costs;
  const std::map<std::string, std::string> tables = tables_after(scene, 2 * scene.time.steps_per_frame(), costs);
  CHECK(tables.size() == 5);
  CHECK(lines_of(tables.at("trajectory.csv")) == 1 + 3 * 8);  // eight grains
  CHECK(lines_of(tables.at("energies.csv")) == 1 + 3);
  CHECK(lines_of(tables.at("state.csv")) == 1 + 3);
  CHECK(lines_of(tables.at("final_state.csv")) == 1 + 8);           // of the end alone
  CHECK(lines_of(tables.at("measurements/fabric.csv")) == 1 + 40);  // none at the start
  REQUIRE(costs.size() == 1);
  CHECK(costs[0].state.samples == 40);
}

TEST_CASE("tables: a scene may request one with an interval of its own") {
  const Scene scene = scene_with("kind = \"state\"\nname = \"often\"\n");
  std::vector<MeasurementCost> costs;
  const std::map<std::string, std::string> tables = tables_after(scene, scene.time.steps_per_frame(), costs);
  const std::string& often = tables.at("measurements/often.csv");
  CHECK(lines_of(often) == 1 + 21);
  std::istringstream frames(tables.at("state.csv"));
  for (std::string line; std::getline(frames, line);) CHECK(often.find(line + '\n') != std::string::npos);
}

TEST_CASE("tables: parts.csv has the force, the torque or the stress of a drive, and nothing of a part that is moved") {
  const std::string at = "shape = \"box\"\nsize = [0.01, 0.01, 0.01]\nposition = [0.02, 0.02, 0.";
  const auto part = [&](const char* name, const char* height, const char* rest) {
    return std::string("[[part]]\nname = \"") + name + "\"\n" + at + height + "]\n" + rest;
  };
  std::string text = kSceneText;
  text += part("moved", "5", "[[part.motion]]\nkind = \"velocity\"\nvelocity = [0, 0, 1]\n");
  text += part("pushed", "6", "[part.drive]\naxis = [0, 0, 1]\nforce = 3\nmass = 1\n");
  text += part("turned", "7", "[part.drive]\naxis = [0, 0, 1]\npoint = [0, 0, 0]\ntorque = 4\nmoment = 1\n");
  text += part("servo", "8", "[part.drive]\naxis = [0, 0, 1]\nstress = 50\ngain = 1e-3\nlargest_speed = 1\narea = 0.1\n");
  const Scene scene = scene_with("kind = \"fabric\"\n", text);
  std::vector<MeasurementCost> costs;
  std::istringstream lines(tables_after(scene, scene.time.steps_per_frame(), costs).at("parts.csv"));
  std::map<std::string, std::vector<std::string>> last;
  std::string head, line;
  std::getline(lines, head);
  CHECK(head.ends_with("drive_force_N,drive_torque_Nm,servo_stress_Pa"));
  while (std::getline(lines, line)) {
    const std::vector<std::string> fields = split(line);
    last[fields[1]] = {fields.end() - 3, fields.end()};
  }
  using Fields = std::vector<std::string>;
  CHECK(last.at("moved") == Fields{"", "", ""});
  CHECK(last.at("pushed") == Fields{"3", "", ""});
  CHECK(last.at("turned") == Fields{"", "4", ""});
  CHECK(last.at("servo")[0] == "5");  // 50 Pa on 0.1 m^2
  CHECK(std::abs(std::stod(last.at("servo")[2])) < 1e-9);
}

TEST_CASE("tables: all are listed, and those of a scene with their columns") {
  for (const MeasurementKind& kind : measurement_kinds()) {
    CAPTURE(kind.name);
    CHECK((list_tables().find(kind.name + ".csv\n") != std::string::npos) == kind.on_by_default.has_value());
    CHECK((list_measurements().find("kind = \"" + kind.name + '"') != std::string::npos) != kind.on_by_default.has_value());
  }
  const std::string tables = tables_of(scene_with("kind = \"energies\"\n"));
  CHECK(tables.find("\"energies.csv\" = [\"time_s\", \"kinetic_J\", ") != std::string::npos);
  CHECK(tables.find("\"measurements/energies.csv\" = [\"time_s\", \"kinetic_J\", ") != std::string::npos);
  CHECK(tables.find("discharge.csv") == std::string::npos);
}
