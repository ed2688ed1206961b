// Drops real grains into a container, or packs them in a periodic cell, and measures the result. It reads a scene file and writes
// tables, pictures and a summary.

#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <supernormal/effects.hpp>
#include <utility>
#include <vector>

#include "advise/doubts.hpp"
#include "advise/forecast.hpp"
#include "advise/refusals.hpp"
#include "base/interrupt.hpp"
#include "common/input_error.hpp"
#include "input/load_sections.hpp"
#include "model/scene.hpp"
#include "observe/measuring.hpp"
#include "output/lammps_input.hpp"
#include "output/rendering.hpp"
#include "run/run.hpp"

namespace {

enum ExitCode { Done = 0, Failed = 1, BadInput = 2, Leaked = 3, Interrupted = 130 };

constexpr const char* kFooter =
    "Writes OUT/<scene>/trajectory.csv, energies.csv, state.csv, final_state.csv, summary.toml, of a hopper discharge.csv, of a "
    "packing\n"
    "compression.csv, of parts that move parts.csv, of feeders and sinks feeders.csv and sinks.csv, of bonds\n"
    "bonds.csv, broken_bonds.csv and final_bonds.csv, and the pictures that the "
    "scene\n"
    "asks for, view.html, scene.glb and plots of tables if it does not say; until the end they are in "
    "OUT/<scene>.unfinished-1. If the run is killed the tables stay\n"
    "there, up to the last frame, until the next run of the scene; with --checkpoint-every, --resume goes on from there.\n"
    "Exit code: 0 done; 1 failed (disk full, say, or stdout closed): results of an earlier run stay unless there are new ones;\n"
    "2 bad input, nothing written;\n"
    "3 with --check-leaks: a grain left the container, all results written;\n"
    "130 stopped by Ctrl-C, with all results up to then written; with --checkpoint-every, at a checkpoint, to be resumed.";

void list() {
  std::puts("A scene has these sections and keys, and those below. Where no default is named, a key is needed.\n");
  std::fputs(falling_particles::kSectionsList, stdout);
  std::puts(
      "\nA scene runs with the effects whose sections it has, and with nothing else. With `enabled = false` in its section an "
      "effect "
      "is left out.\nRigid contact itself is 1 row a contact.\n");
  for (const supernormal::effects::Description& effect : supernormal::effects::descriptions()) {
    std::printf("[%s]\n  parameters  %s\n  cost        %d rows per contact; passes per step: %s\n  source      %s\n", effect.name,
                falling_particles::scene_parameters(effect).c_str(), effect.rows, effect.passes, effect.source);
  }
  std::puts("\nIt measures what its sections [[measurement]] request, each into measurements/NAME.csv. Parameters of all:\n");
  std::puts("  interval: s, from sample to sample, a multiple of time.step; name: of the table, the kind without it;");
  std::puts("  from, until: s, of the first and the last sample, the whole run without them\n");
  std::fputs(falling_particles::list_measurements().c_str(), stdout);
  std::puts("\nWalls besides those of its container, which stand, move or are driven, are its sections [[part]].\n");
  std::fputs(falling_particles::kWallsList, stdout);
  std::puts(
      "\nThese tables are on by default. A section [[measurement]] with a kind of their names writes one more, with its own "
      "interval.");
  std::puts("--tables SCENE prints the columns of a scene's tables.\n");
  std::fputs(falling_particles::list_tables().c_str(), stdout);
  std::puts("\nGrains come from its sections [[feeder]], and go into its sections [[sink]].\n");
  std::fputs(falling_particles::kPopulationList, stdout);
}

void print_tables(const std::string& scene_path, const std::vector<std::string>& overrides) {
  std::fputs(tables_of(falling_particles::load_scene(scene_path, overrides)).c_str(), stdout);
}

/// Everything that results depend on besides the files and options of a run.
std::string version() {
  return std::string("falling_particles ") + FALLING_PARTICLES_VERSION + ", ODE with " +
         (sizeof(dReal) == sizeof(double) ? "double" : "single") + " precision";
}

void check(const std::string& scene_path, const std::vector<std::string>& overrides) {
  const falling_particles::Scene scene = falling_particles::load_scene(scene_path, overrides);
  falling_particles::refuse_bad_start(scene);
  std::fputs(describe(scene, falling_particles::forecast(scene)).c_str(), stdout);
}

struct Options {
  std::string scene_path;
  std::vector<std::string> overrides;
  std::string check_path;
  std::string tables_path;
  falling_particles::RunOptions run;
  bool check_leaks = false;
  bool no_pictures = false;
  std::string to_lammps;
};

void warn(const std::vector<std::string>& doubts) {
  for (const std::string& doubt : doubts) std::fprintf(stderr, "falling_particles: warning: %s\n", doubt.c_str());
}

/// The last lines of a run: what there is to look at, and how.
void tell_pictures(const std::filesystem::path& folder) {
  for (const auto& [file, use] : {std::pair{"view.html", "a browser plays the run"}, {"still.png", "its last moment"}}) {
    if (std::filesystem::exists(folder / file)) std::fprintf(stderr, "xdg-open %s    # %s\n", (folder / file).c_str(), use);
  }
}

ExitCode simulate(const Options& options) {
  falling_particles::Scene scene = falling_particles::load_scene(options.scene_path, options.overrides);
  if (!options.to_lammps.empty()) {
    warn(falling_particles::write_lammps_input(scene, options.to_lammps));
    return Done;
  }
  falling_particles::refuse_bad_start(scene);
  warn(falling_particles::doubts_about(scene));
  if (options.no_pictures) scene.pictures.clear();
  falling_particles::catch_interrupts();
  const falling_particles::RunEnd end = falling_particles::run(scene, options.run);
  std::fflush(stdout);
  falling_particles::catch_interrupts();  // again: the results are in place, and Ctrl-C ends only the drawing
  falling_particles::render(end.renderings, end.folder, options.run.quiet);
  if (!options.run.quiet) tell_pictures(end.folder);
  if (end.interrupted || falling_particles::interrupted()) return Interrupted;
  return end.leaked && options.check_leaks ? Leaked : Done;
}

ExitCode run_program(int argc, char** argv) {
  CLI::App app("Simulates falling grains in a container with ODE and Supernormal.", "falling_particles");
  Options options;
  CLI::Option* const scene = app.add_option("-s,--scene,SCENE", options.scene_path, "scene file (TOML)");
  CLI::Option* const checked =
      app.add_option("--check", options.check_path,
                     "scene file: say what its run would do and take, and end. Takes a second or two, and writes nothing");
  checked->excludes(scene)->check([](const std::string& path) {
    return path.starts_with("--") ? "it takes the scene file itself, and the other options after it" : "";
  });
  CLI::Option* const tabled = app.add_option("--tables", options.tables_path,
                                             "scene file: print the tables that its run would write, with columns, as TOML")
                                  ->excludes(scene)
                                  ->excludes(checked);
  app.add_option("--set", options.overrides, "another value than the scene's, once for each: time.step=1e-3, grain[pea].count=20")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("-o,--out", options.run.out, "folder for the results")->capture_default_str();
  app.add_option("-t,--threads", options.run.threads,
                 "that look for contacts; 0: as many as the machine has. Same results with any number")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  app.add_flag("-q,--quiet", options.run.quiet, "no progress");
  app.add_flag("--check-leaks", options.check_leaks, "exit with 3 when a grain leaves its container");
  app.add_option("--to-lammps", options.to_lammps, "write the scene as an input of samples/lammps to this folder, and run nothing");
  app.add_option("--checkpoint-every", options.run.checkpoint_every,
                 "save the run after as many steps each, to go on from there; a signal ends it at the next checkpoint")
      ->check(CLI::Range(1, 1'000'000'000));
  app.add_flag("--resume", options.run.resume,
               "go on from the checkpoint of a run of the scene that was killed; start when there is none");
  app.add_flag("--no-pictures", options.no_pictures, "leave nothing but the tables, whatever the scene asks for");
  const auto list_and_end = [] {
    list();
    throw CLI::Success();
  };
  app.add_flag_callback(
      "--list", list_and_end,
      "print the effects, measurements, parts, feeders and sinks that a scene may name, with units, ranges, costs and sources");
  app.set_version_flag("--version", version(), "print the version, and the precision of ODE");
  app.footer(kFooter);
  try {
    app.parse(argc, argv);
    if (scene->count() + checked->count() + tabled->count() == 0) throw CLI::RequiredError("--scene");
  } catch (const CLI::ExtrasError&) {
    std::vector<std::string> unknown = app.remaining();
    std::ranges::reverse(unknown);  // ExtrasError lists them in reverse
    app.exit(CLI::ExtrasError(unknown));
    return BadInput;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? Done : BadInput;
  }
  if (scene->count() > 0) return simulate(options);
  if (checked->count() > 0) check(options.check_path, options.overrides);
  if (tabled->count() > 0) print_tables(options.tables_path, options.overrides);
  return Done;
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
