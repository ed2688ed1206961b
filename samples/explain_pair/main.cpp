// Draws a picture that explains how the gap of a pair of bodies is found.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.hpp"
#include "base/write_file.hpp"
#include "drawing/lengths.hpp"
#include "drawing/picture.hpp"
#include "method/explanation.hpp"
#include "pair/described_body.hpp"
#include "pair/hard_case.hpp"
#include "pair/recorded_pair.hpp"

namespace {

using namespace explain_pair;
using falling_particles::InputError;

enum ExitCode { Done = 0, Failed = 1, BadInput = 2 };

struct DescribedBody {
  std::string text;
  double rounding = 0;                              // m
  std::array<double, 3> position = {0, 0, 0};       // m
  std::array<double, 4> quaternion = {1, 0, 0, 0};  // w, x, y, z
};

struct Options {
  DescribedBody body1, body2;
  std::string title = "One pair of bodies";
  std::string hard_case;
  std::string scene, trajectory;
  std::vector<std::string> overrides;
  double time = 0;
  std::vector<std::size_t> bodies;
  std::string out = "pair.svg";
  supernormal::Settings settings;
  bool has_literature = false;
};

void add_body(CLI::App& app, const std::string& number, DescribedBody& body) {
  const std::string group = "Body " + number;
  app.add_option("--body" + number, body.text, "kind and parameters, in quotes")->group(group);
  app.add_option("--rounding" + number, body.rounding, "m; radius of a sphere that sweeps the body")->group(group);
  app.add_option("--position" + number, body.position, "x y z of its centre, m")->group(group);
  app.add_option("--quaternion" + number, body.quaternion, "w x y z of its attitude, of unit length")->group(group);
}

PlacedBody placed(const std::string& number, const DescribedBody& described) {
  PlacedBody body = described_body(number, described.text, described.rounding);
  body.pose.position = position_of("--position" + number, described.position);
  body.pose.rotation = rotation_of("--quaternion" + number, described.quaternion);
  return body;
}

Pair chosen_pair(const Options& options) {
  const bool is_described = !options.body1.text.empty() || !options.body2.text.empty();
  const bool is_recorded = !options.scene.empty() || !options.trajectory.empty();
  const int choices = (is_described ? 1 : 0) + (is_recorded ? 1 : 0) + (options.hard_case.empty() ? 0 : 1);
  if (choices != 1) {
    throw InputError(std::to_string(choices) +
                     " pairs are named; allowed: one, by --body1 and --body2, by --scene and --trajectory, or by --case");
  }
  if (!options.hard_case.empty()) return hard_case(options.hard_case);
  if (is_described) return {.title = options.title, .body1 = placed("1", options.body1), .body2 = placed("2", options.body2)};
  if (options.bodies.empty() || options.scene.empty() || options.trajectory.empty()) {
    throw InputError("a pair of a run takes --scene, --trajectory, --time and --bodies; missing: " +
                     std::string(options.scene.empty()        ? "--scene"
                                 : options.trajectory.empty() ? "--trajectory"
                                                              : "--bodies"));
  }
  std::optional<std::size_t> second;
  if (options.bodies.size() > 1) second = options.bodies[1];
  return recorded_pair({options.scene, options.trajectory, options.time, options.bodies[0], second, options.overrides});
}

void print(const Explanation& explanation) {
  for (const SolverPath& path : explanation.paths) {
    std::printf("%-32s gap %s, %d evaluations, %s%s\n", path.name.c_str(), length_text(path.answer.gap, 10).c_str(),
                path.answer.evaluations, name_of(path.answer.status), path.answer.is_global ? ", proved" : "");
  }
}

ExitCode run_program(int argc, char** argv) {
  CLI::App app("Draws a pair of bodies with its common normal, and how the solvers find it on the sphere of normals.",
               "explain_pair");
  Options options;
  add_body(app, "1", options.body1);
  add_body(app, "2", options.body2);
  app.add_option("--title", options.title, "of the picture of two described bodies")->capture_default_str();
  app.add_option("--case", options.hard_case, "a hard case by its name")->group("Hard case");
  app.add_flag_callback(
         "--list",
         [] {
           std::fputs(list_of_hard_cases().c_str(), stdout);
           throw CLI::Success();
         },
         "print the names of the hard cases, and why they are hard")
      ->group("Hard case");
  const std::string run = "Two grains of a run";
  app.add_option("--scene", options.scene, "scene file")->group(run);
  app.add_option("--set", options.overrides, "what the run was given with --set, once for each")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->group(run);
  app.add_option("--trajectory", options.trajectory, "trajectory.csv that its run has left")->group(run);
  app.add_option("--time", options.time, "s, of a frame")->group(run);
  app.add_option("--bodies", options.bodies, "their indices; of one alone: with its neighbour")->expected(1, 2)->group(run);
  app.add_option("-o,--out", options.out, "the picture")->capture_default_str();
  app.add_option("--tolerance", options.settings.tolerance, "of the gap, relative to the smallest half-extent")
      ->check(CLI::Range(1e-15, 1.0))
      ->capture_default_str();
  app.add_option("--max-evaluations", options.settings.max_evaluations, "of the gap function, for each solver")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--certify", options.settings.certify_depth, "let the hybrid prove that the depth is the smallest");
  app.add_flag("--literature", options.has_literature,
               "draw the methods of the literature too, if both bodies are superellipsoids");
  app.footer("Kinds of bodies:\n" + body_kinds() + "Exit code: 0 done; 1 failed (disk full, say); 2 bad input, nothing written.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? Done : BadInput;
  }
  const Methods methods = options.has_literature ? Methods::OfLiteratureToo : Methods::OfLibrary;
  const Explanation explanation = explain(chosen_pair(options), options.settings, methods);
  falling_particles::replace_file(options.out, picture_of(explanation));
  print(explanation);
  return Done;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return BadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "explain_pair: %s\n", error.what());
    return Failed;
  }
}
