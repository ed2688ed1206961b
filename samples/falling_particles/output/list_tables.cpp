#include "list_tables.hpp"

#include <algorithm>

#include "base/toml_string.hpp"
#include "observe/measuring.hpp"
#include "observe/simulation.hpp"
#include "output_files.hpp"

namespace falling_particles {
namespace {

/// `columns`: names without quotes, separated by commas.
std::string toml_line(const std::string& table, const std::string& columns) {
  std::string names;
  for (std::size_t at = 0; at < columns.size();) {
    const std::size_t end = std::min(columns.find(',', at), columns.size());
    names += (names.empty() ? "" : ", ") + toml_string(columns.substr(at, end - at));
    at = end + 1;
  }
  return toml_string(table) + " = [" + names + "]\n";
}

}  // namespace

std::string list_tables() {
  std::string text;
  for (const TableFormat& format : table_formats()) {
    text += std::string(format.name) + "\n  lines       one for " + std::string(format.lines) + "; of " + std::string(format.of) +
            "\n  columns     " + std::string(format.columns) + '\n';
  }
  return text;
}

std::string tables_of(const Scene& scene) {
  std::string text;
  for (const TableFormat& format : table_formats()) {
    if (format.is_written(scene)) text += toml_line(std::string(format.name), std::string(format.columns));
  }
  if (scene.measurements.empty()) return text;
  const Simulation simulation(scene, 1);
  for (const MeasurementRequest& request : scene.measurements) {
    text += toml_line(std::string(kMeasurementFolder) + '/' + request.name + ".csv", request.make(simulation.world)->columns());
  }
  return text;
}

}  // namespace falling_particles
