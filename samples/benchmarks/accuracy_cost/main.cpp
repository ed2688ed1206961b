// Measures the cost of a query: our solvers and libccd on the same pairs of bodies, with the same support function, in one run.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "box_cost.hpp"
#include "common/measured_tables.hpp"
#include "common/python_script.hpp"
#include "measurement.hpp"
#include "ode/collider_cost.hpp"
#include "ode/collider_sweep.hpp"
#include "ode/face_cost.hpp"
#include "ode/pair_cost.hpp"
#include "query_cost.hpp"
#include "report/environment.hpp"
#include "report/report.hpp"

namespace {

using namespace accuracy_cost;

constexpr std::size_t kAtlasPairs = 240;     // per class and situation: 6000 in all
constexpr std::size_t kAtlasMeshPairs = 12;  // each needs four meshes of every size
constexpr std::size_t kAtlasBodies = 1000;   // per class, for bounding boxes
constexpr std::size_t kAtlasPoses = 100;     // per collider
constexpr std::size_t kPairRows = 6;         // of the table of --dcollide

struct Options {
  std::size_t pairs = 6000;
  std::uint64_t seed = 1;
  int rounds = Effort{}.rounds;
  double batch_us = Effort{}.batch * 1e6;
  std::string csv;
  bool colliders = false;
  std::size_t poses = 200;
  bool faces = false;
  bool dcollide = false;
  bool atlas = false;
  bool literature = false;
  bool boxes = false;
  std::string out = "out/accuracy_cost";
};

void run(const Options& options) {
  const Effort effort{options.rounds, options.batch_us * 1e-6};
  if (options.atlas || options.literature || options.boxes) {
    std::vector<common::MeasuredTable> tables;
    if (options.atlas) {
      tables.push_back(query_costs(kAtlasPairs, options.seed, effort));
      tables.push_back(mesh_costs(kAtlasMeshPairs, options.seed, effort));
      tables.push_back(collider_sweep(kAtlasPoses, options.seed, effort));
    }
    if (options.atlas || options.literature) tables.push_back(literature_costs(kAtlasPairs, options.seed, effort));
    if (options.atlas || options.boxes) tables.push_back(box_costs(kAtlasBodies, options.seed, effort));
    measure_tables(tables, environment(), options.out);
    common::become_python(ACCURACY_COST_REPORT, options.out);  // writes report.md and draws the figures
  }
  if (options.colliders) {
    write_collider_costs(options.poses, options.seed, effort, std::cout);
    return;
  }
  if (options.faces) {
    write_face_costs(effort, std::cout);
    return;
  }
  if (options.dcollide) {
    write_pair_costs(options.pairs / kPairRows, options.seed, effort, std::cout);
    return;
  }
  std::vector<Pair> pairs = draw_pairs(options.pairs, options.seed);
  Methods methods = supernormal_methods();
  for (Methods more = libccd_methods(); auto& method : more) methods.push_back(std::move(method));
  methods.push_back(evaluation_cost(supernormal::Order::Point));
  methods.push_back(evaluation_cost(supernormal::Order::Hessian));
  methods.push_back(floor_cost());

  const auto samples = measure(methods, pairs, effort);
  improve_references(samples, pairs);
  const Results results{pairs, methods, samples};
  write_markdown(results, std::cout);
  if (!options.csv.empty()) write_csv(results, options.csv);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Measures what a query of two smooth bodies costs and how accurate its answer is.", "accuracy_cost");
    Options options;
    app.add_option("--pairs", options.pairs, "pairs of bodies, over all classes and poses")
        ->check(CLI::Range(12, 10000000))
        ->capture_default_str();
    app.add_option("--seed", options.seed, "of the draw")->capture_default_str();
    app.add_option("--rounds", options.rounds, "timings of each pair and method")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    app.add_option("--batch", options.batch_us, "microseconds for which each timing repeats its query; 0: asked once")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    CLI::Option* const csv = app.add_option("--csv", options.csv, "file for the results");
    app.add_flag("--colliders", options.colliders, "times dCollide against every class of ODE instead")->excludes(csv);
    app.add_option("--poses", options.poses, "with --colliders: of each body at each collider")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    app.add_flag("--faces", options.faces, "times dCollide of bodies at rest, by their exponents, instead")->excludes(csv);
    app.add_flag("--dcollide", options.dcollide, "times dCollide of two of our bodies beside libccd instead")->excludes(csv);
    app.add_flag("--atlas", options.atlas,
                 "measures all levels instead: queries, meshes, colliders, boxes; scene_cost measures scenes into the same folder")
        ->excludes(csv);
    app.add_flag("--literature", options.literature, "compares with the methods of the literature instead")->excludes(csv);
    app.add_flag("--boxes", options.boxes, "compares the ways to a bounding box instead")->excludes(csv);
    app.add_option("--out", options.out,
                   "with --atlas, --literature and --boxes: folder for the results; what is there is not measured again")
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "accuracy_cost: %s\n", error.what());
    return 1;
  }
  return 0;
}
