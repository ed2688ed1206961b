#include "output/plots.hpp"

#include <string>
#include <variant>

// The texts of the scripts (plot_scripts.S).
extern "C" const char kEnergiesScript[], kStateScript[], kDischargeScript[], kCompressionScript[];

namespace falling_particles {
namespace {

Rendering plot(const std::string& table, const char* script) {
  return {table + ".svg", {"gnuplot", "-c", "/dev/stdin", table + ".csv"}, script, "gnuplot-nox"};
}

}  // namespace

std::vector<Rendering> Plots::renderings() const {
  std::vector<Rendering> plots = {plot("energies", kEnergiesScript), plot("state", kStateScript)};
  if (std::holds_alternative<Hopper>(contents_.scene->container)) plots.push_back(plot("discharge", kDischargeScript));
  if (contents_.scene->compression) plots.push_back(plot("compression", kCompressionScript));
  return plots;
}

}  // namespace falling_particles
