#include "output/plots.hpp"

#include <string>
#include <variant>

// The texts of the scripts (plot_scripts.S).
extern "C" const char plot_energies[], plot_state[], plot_discharge[], plot_compression[];

namespace falling_particles {
namespace {

Rendering plot(const std::string& table, const char* script) {
  return {table + ".svg", {"gnuplot", "-c", "/dev/stdin", table + ".csv"}, script, "gnuplot-nox"};
}

}  // namespace

std::vector<Rendering> Plots::renderings() const {
  std::vector<Rendering> plots = {plot("energies", plot_energies), plot("state", plot_state)};
  if (std::holds_alternative<Hopper>(contents_.scene->container)) plots.push_back(plot("discharge", plot_discharge));
  if (contents_.scene->compression) plots.push_back(plot("compression", plot_compression));
  return plots;
}

}  // namespace falling_particles
