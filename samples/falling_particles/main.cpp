// Drops a mixture of real grains into a box and watches it settle: a scene file in, trajectories and a summary out.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "input_error.hpp"
#include "interrupt.hpp"
#include "run.hpp"
#include "scene.hpp"

namespace {

enum ExitCode { Done = 0, Failed = 1, BadInput = 2, Interrupted = 130 };

constexpr const char* kFooter =
    "Writes OUT/<scene>/trajectory.csv, energies.csv and summary.toml.\n"
    "Exit code: 0 done; 1 failed (disk full, say); 2 bad input, nothing written;\n"
    "130 stopped by Ctrl-C, with all results up to then written.";

ExitCode simulate(const std::string& scene_path, const std::string& out, bool quiet) {
  const falling_particles::Scene scene = falling_particles::load_scene(scene_path);
  falling_particles::catch_interrupts();
  return falling_particles::run(scene, out, quiet) == falling_particles::RunEnd::Completed ? Done : Interrupted;
}

ExitCode run_program(int argc, char** argv) {
  CLI::App app("Simulates falling grains in a box with ODE and Supernormal.", "falling_particles");
  std::string scene_path;
  std::string out = "out";
  bool quiet = false;
  app.add_option("-s,--scene", scene_path, "scene file (TOML)")->required();
  app.add_option("-o,--out", out, "folder for the results")->capture_default_str();
  app.add_flag("-q,--quiet", quiet, "no progress");
  app.footer(kFooter);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? Done : BadInput;
  }
  return simulate(scene_path, out, quiet);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const falling_particles::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return BadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "falling_particles: %s\n", error.what());
    return Failed;
  }
}
