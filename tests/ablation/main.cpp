// Changes one constant of the solver at a time (lib/proximity/gap/tuning.hpp). Prints the cost over fixed sets of pairs.
//
//     ablation [--pairs 3000] [--samples 20000] [--only name] [--list]
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <variant>
#include <vector>

#include "measurement.hpp"
#include "proximity/gap/tuning.hpp"

namespace supernormal::ablation {
namespace {

/// One constant and the values that replace it: the value that switches its mechanism off, if there is one, and others.
struct Trial {
  const char* name;
  std::variant<double Tuning::*, int Tuning::*> constant;
  std::vector<double> values;
};

std::vector<Trial> trials() {
  return {{"newton_evaluations", &Tuning::newton_evaluations, {0, 4, 8}},
          {"same_tilt", &Tuning::same_tilt, {0.01, 3}},
          {"longest_step", &Tuning::longest_step, {0.5, 3}},
          {"poor_fraction", &Tuning::poor_fraction, {0.01, 0.3}},
          {"short_fraction", &Tuning::short_fraction, {1.3, 1e9}},
          {"creep", &Tuning::creep, {0, 0.1}},
          {"gain_safety", &Tuning::gain_safety, {1, 10}},
          {"unsearched_depth", &Tuning::unsearched_depth, {0, 0.1}},
          {"depth_per_radius", &Tuning::depth_per_radius, {0, 1, 2}},
          {"search_width", &Tuning::search_width, {0.01, 0.1}},
          {"search_evaluations", &Tuning::search_evaluations, {20, 100}},
          {"near_best", &Tuning::near_best, {0, 0.06}},
          {"leaving_gain", &Tuning::leaving_gain, {0, 0.33}},
          {"same_basin_cosine", &Tuning::same_basin_cosine, {0.98, 0.9999}}};
}

void print(const std::string& name, const Figures& figures) {
  std::printf("%-28s", name.c_str());
  for (const Counts* counts : {&figures.reference, &figures.catalogue, &figures.smooth, &figures.kinked, &figures.no_hessian,
                               &figures.soak, &figures.sharp}) {
    std::printf(" | %6.2f %4ld %3ld %3ld", counts->evaluations_per_query(), counts->unconverged, counts->missed,
                counts->violations);
  }
  std::printf("\n");
  std::fflush(stdout);
}

void print_header() {
  std::printf("%-28s", "");
  for (const char* set : {"reference", "hard cases", "smooth", "kinked", "no Hessian", "soak", "sharp soak"})
    std::printf(" | %-19s", set);
  std::printf("\n%-28s", "");
  for (int set = 0; set < 7; ++set) std::printf(" | %6s %4s %3s %3s", "evals", "not", "mis", "vio");
  std::printf("\n");
}

/// Replaces a constant by the value as long as it lives.
class Changed {
 public:
  Changed(const Trial& trial, double value) : before_(kTuning) {
    std::visit([&](auto member) { kTuning.*member = static_cast<std::remove_reference_t<decltype(kTuning.*member)>>(value); },
               trial.constant);
  }
  ~Changed() { kTuning = before_; }
  Changed(const Changed&) = delete;
  Changed& operator=(const Changed&) = delete;

 private:
  Tuning before_;
};

int run(int argc, char** argv) {
  int pairs = 3000, samples = 20000;
  std::string only;
  CLI::App app("What each constant of the solver is for");
  app.add_option("--pairs", pairs, "of each random set");
  app.add_option("--samples", samples, "of each of the soak's mixes");
  app.add_option("--only", only, "constants whose names contain this");
  CLI11_PARSE(app, argc, argv);
  const Measurement measurement(pairs, samples);
  std::printf(
      "Evaluations a query; answers that have not converged (default tolerance or looser); converged, but more than 1e-6 of the\n"
      "smallest half-extent below the proved maximum; violations of the contract.\n\n");
  print_header();
  print("as it is", measurement.measure());
  for (const Trial& trial : trials()) {
    if (std::string(trial.name).find(only) == std::string::npos) continue;
    for (const double value : trial.values) {
      const Changed changed(trial, value);
      char text[64];
      std::snprintf(text, sizeof text, "%s = %g", trial.name, value);
      print(text, measurement.measure());
    }
  }
  return 0;
}

}  // namespace
}  // namespace supernormal::ablation

int main(int argc, char** argv) {
  try {
    return supernormal::ablation::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ablation: %s\n", error.what());
    return 2;
  }
}
