#include "plots.hpp"

#include <string>
#include <variant>

#include "observe/measuring.hpp"

// The texts of the scripts (plot_scripts.S).
extern "C" const char kEnergiesScript[], kStateScript[], kDischargeScript[], kCompressionScript[], kMeasurementScript[];

namespace falling_particles {
namespace {

Rendering plot(const std::string& table, const char* script) {
  return {table + ".svg", {"gnuplot", "-c", "/dev/stdin", table + ".csv"}, script, "gnuplot-nox"};
}

/// Adds a plot of a measurement's table, if its kind has one.
void add_plot(std::vector<Rendering>& plots, const MeasurementRequest& request) {
  const MeasurementKind& kind = *find_measurement_kind(request.kind);
  if (kind.plotted.empty()) return;
  Rendering& rendering = plots.emplace_back(plot(std::string(kMeasurementFolder) + '/' + request.name, kMeasurementScript));
  rendering.command.push_back(kind.plot_label);
  for (const std::string& column : kind.plotted) rendering.command.push_back(column);
}

}  // namespace

std::vector<Rendering> Plots::renderings() const {
  std::vector<Rendering> plots = {plot("energies", kEnergiesScript), plot("state", kStateScript)};
  if (std::holds_alternative<Hopper>(contents_.scene->container)) plots.push_back(plot("discharge", kDischargeScript));
  if (contents_.scene->compression) plots.push_back(plot("compression", kCompressionScript));
  for (const MeasurementRequest& request : contents_.scene->measurements) add_plot(plots, request);
  return plots;
}

}  // namespace falling_particles
