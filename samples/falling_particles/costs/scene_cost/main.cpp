// Measures what accuracy costs in a simulation: a scene of grains as bodies of several geometry classes.

#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "common/environment.hpp"
#include "common/measured_tables.hpp"
#include "common/python_script.hpp"
#include "scene_tables.hpp"

namespace {

/// That of the build, and the libraries whose colliders a scene has.
common::Environment environment() {
  common::Environment lines = common::environment();
  lines.emplace_back("ODE", dODE_VERSION);
  lines.emplace_back("libccd (by its ccd.pc)", SCENE_COST_CCD_VERSION);
  return lines;
}

int run_program(int argc, char** argv) {
  CLI::App app("Times a scene of grains as bodies of our class and of ODE's, and compares what comes out.", "scene_cost");
  std::string scene_path = "samples/scenes/pile.toml";
  std::string out = "out/accuracy_cost";
  app.add_option("--scene-file", scene_path, "the grains, in a box")->capture_default_str();
  app.add_option("--out", out, "folder for the results, also those of accuracy_cost; what is there is not measured again")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  using scene_cost::scene_forms, scene_cost::scene_growth, scene_cost::scene_outcomes;
  common::measure_tables({scene_forms(scene_path), scene_growth(scene_path), scene_outcomes(scene_path)}, environment(), out);
  const std::string report = SCENE_COST_REPORT;
  if (std::filesystem::exists(report)) common::become_python(report, out);  // writes report.md and draws the figures
  std::printf("python3 samples/benchmarks/accuracy_cost/report.py %s writes the report; %s is missing\n", out.c_str(),
              report.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scene_cost: %s\n", error.what());
    return 1;
  }
}
