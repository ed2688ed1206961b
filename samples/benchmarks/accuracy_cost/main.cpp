// Measures the cost of a query: our solvers and others on the same pairs of bodies, with the same support function, in one run.

#include <supernormal/supernormal.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/measured_tables.hpp"
#include "costs.hpp"
#include "measurement.hpp"

namespace {

using namespace accuracy_cost;

constexpr std::size_t kAtlasPairs = 240;  // per class and situation: 6000 in all
constexpr std::size_t kPairRows = 12;     // of the table of --dcollide

struct Options {
  std::size_t pairs = 6000;
  std::uint64_t seed = 1;
  int rounds = Effort{}.rounds;
  double batch_us = Effort{}.batch * 1e6;
  bool colliders = false;
  std::size_t poses = 200;
  bool faces = false;
  bool dcollide = false;
  bool atlas = false;
  bool literature = false;
  std::string out = "out/accuracy_cost";
};

void run(const Options& options) {
  const Effort effort{options.rounds, options.batch_us * 1e-6};
  if (options.colliders || options.faces || options.dcollide) {
    if (snInit() == 0) throw std::runtime_error(snLastError());
    for (const auto& [name, value] : environment()) std::cout << "* " << name << ": " << value << "\n";
    if (options.colliders) write_collider_costs(options.poses, options.seed, effort, std::cout);
    if (options.faces) write_face_costs(effort, std::cout);
    if (options.dcollide) write_pair_costs(options.pairs / kPairRows, options.seed, effort, std::cout);
    return snClose();
  }
  std::vector<common::MeasuredTable> tables;
  if (options.atlas) tables.push_back(query_costs(kAtlasPairs, options.seed, effort));
  tables.push_back(literature_costs(kAtlasPairs, options.seed, effort));
  measure_tables(tables, environment(), options.out);
  common::become_python(ACCURACY_COST_REPORT, options.out);  // writes report.md and draws the figures
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Measures what a query of two smooth bodies costs and how accurate its answer is.", "accuracy_cost");
    Options options;
    CLI::Option_group* const what = app.add_option_group("what", "one of these");
    what->require_option(1);
    what->add_flag("--atlas", options.atlas,
                   "queries at every accuracy, also of the literature; scene_cost measures scenes into the same folder");
    what->add_flag("--literature", options.literature, "our solvers beside the methods of the literature");
    what->add_flag("--colliders", options.colliders, "dCollide against every class of ODE");
    what->add_flag("--faces", options.faces, "dCollide of bodies at rest, by their exponents");
    what->add_flag("--dcollide", options.dcollide, "dCollide of two of our bodies beside libccd");
    app.add_option("--seed", options.seed, "of the draw")->capture_default_str();
    app.add_option("--rounds", options.rounds, "timings of each pair and method")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    app.add_option("--batch", options.batch_us, "microseconds for which each timing repeats its query; 0: asked once")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    app.add_option("--pairs", options.pairs, "with --dcollide: of bodies")->check(CLI::Range(12, 10000000))->capture_default_str();
    app.add_option("--poses", options.poses, "with --colliders: of each body at each collider")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    app.add_option("--out", options.out,
                   "with --atlas and --literature: folder for the results; what is there is not measured again")
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "accuracy_cost: %s\n", error.what());
    return 1;
  }
  return 0;
}
