// Tables of measurements in worlds of a few grains.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "observe/measurement.hpp"
#include "scenes.hpp"
#include "world/stepper.hpp"

namespace falling_particles {

/// A table, parsed.
struct MeasuredTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  const std::string& text(const std::string& column, std::size_t row = 0) const {
    const auto found = std::ranges::find(columns, column);
    REQUIRE(found != columns.end());
    REQUIRE(row < rows.size());
    REQUIRE(rows[row].size() == columns.size());
    return rows[row][static_cast<std::size_t>(found - columns.begin())];
  }
  double number(const std::string& column, std::size_t row = 0) const { return std::stod(text(column, row)); }
};

inline std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

/// A table's file, with its head.
inline MeasuredTable parsed(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  MeasuredTable table{split(line), {}};
  while (std::getline(lines, line)) table.rows.push_back(split(line));
  return table;
}

/// kSceneText with rods besides and a section [[measurement]] of these lines.
inline Scene scene_with(const std::string& measurement, std::string text = kSceneText) {
  const TemporaryFolder folder;
  folder.write("grains.toml", std::string(kCatalogueText) +
                                  "\n[rod]\nhalf_axes = [2e-3, 6e-3, 3e-3]\ndelta = 2\nepsilon = 2\ndensity = 1200\nsource = "
                                  "\"typical\"\n");
  text += "\n[[grain]]\nname = \"rod\"\ncount = 1\n[[measurement]]\ninterval = 0.0005\n" + measurement;
  return load_scene(folder.write("scene.toml", text));
}

inline constexpr std::size_t kPea = 0;
inline constexpr std::size_t kDie = 1;
inline constexpr std::size_t kRod = 2;

inline Placement upright(std::size_t kind, double x, double y, double z) { return {kind, {x, y, z}, {1, 0, 0, 0}}; }

/// The table of the scene's first measurement at this moment; `stepper`: null where it needs no contacts.
inline MeasuredTable measure(const Scene& scene, const World& world, const Stepper* stepper = nullptr) {
  const std::vector<PairContact> contacts =
      stepper == nullptr ? std::vector<PairContact>() : gather_contacts(stepper->measured_contacts(), world, scene.time.step);
  const std::unique_ptr<Measurement> measurement = scene.measurements.front().make(world);
  TableText table;
  measurement->measure({0, world, contacts}, table);
  MeasuredTable result = parsed(measurement->columns() + '\n' + table.text());
  CHECK(result.rows.size() == table.lines());
  return result;
}

/// Steps, the last time with the forces of the contacts, and measures.
inline MeasuredTable step_and_measure(const Scene& scene, const std::vector<Placement>& placements, int steps) {
  const World world(scene, placements);
  Stepper stepper(world, scene);
  for (int step = 1; step < steps; ++step) stepper.step();
  stepper.step(true);
  return measure(scene, world, &stepper);
}

}  // namespace falling_particles
