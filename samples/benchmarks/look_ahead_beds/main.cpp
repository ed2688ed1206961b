// Measures the benefit of contacts before overlap in a bed of grains. Pours the same beds with plain contacts, with contacts ahead
// and, if available, with Bullet, at several steps. Prints overlaps and costs.

#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bed.hpp"

namespace {

using namespace look_ahead_beds;

constexpr int kMoments = 25;  // instants in the second half at which overlaps are measured

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"plain", start_plain},
      {"ahead", start_ahead},
#ifdef LOOK_AHEAD_BEDS_BULLET
      {"Bullet", start_bullet},
#endif
  };
  return all;
}

struct Options {
  std::vector<std::string> methods = {"plain", "ahead"};
  int grains = 600;
  std::vector<double> exponents = {2, 4, 8, 20, 60};
  std::vector<double> steps = {0.00025, 0.0005, 0.001, 0.002, 0.004, 0.008};
  std::vector<int> iterations = {40};
  double duration = 1;  // s
  std::string csv;
};

/// The second half of a run, when the bed is at rest.
struct Outcome {
  double step = 0;     ///< s
  double deepest = 0;  ///< smallest half-axes of the mean grain
  double mean = 0;     ///< mean over the overlapping pairs, in the same unit
  double seconds = 0;  ///< s of processor time, of a simulated second
};

Outcome pour(const Method& method, const Bed& bed, const Settings& settings, double duration) {
  const std::unique_ptr<Simulation> simulation = method.start(bed, settings);
  const int half = std::max(kMoments, static_cast<int>(std::lround(0.5 * duration / settings.step)));
  for (int step = 0; step < half; ++step) simulation->step();
  Ruler ruler(bed);
  Outcome outcome;
  outcome.step = settings.step;
  std::vector<Pose> poses(bed.grains.size());
  for (int step = 1; step <= half; ++step) {
    const double start = processor_time();
    simulation->step();
    outcome.seconds += (processor_time() - start) / (half * settings.step);
    if (step % (half / kMoments) != 0) continue;
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = simulation->pose(i);
    ruler.measure(poses);
  }
  outcome.deepest = ruler.deepest();
  outcome.mean = ruler.mean();
  return outcome;
}

class Beds {
 public:
  explicit Beds(const Options& options) : options_(options) {
    if (options.csv.empty()) return;
    csv_.open(options.csv, std::ios::app);
    if (!csv_) throw std::runtime_error("cannot write " + options.csv);
    if (csv_.tellp() > 0) return;
    csv_ << "method,grains,exponent,iterations,step_s,deepest,mean,time_s\n";
  }

  void run() {
    std::printf(
        "overlaps in smallest half-axes of the mean grain; processor time of a simulated second, s\n\n"
        "| grains, exponent | method | iterations | step, ms | deepest | mean | time |\n|---|---|---:|---:|---:|---:|---:|\n");
    for (const double exponent : options_.exponents) {
      for (const int iterations : options_.iterations) {
        for (const Method& method : methods()) {
          const bool is_wanted = std::find(options_.methods.begin(), options_.methods.end(), method.name) != options_.methods.end();
          if (is_wanted) sweep(method, exponent, iterations);
        }
      }
    }
  }

 private:
  void sweep(const Method& method, double exponent, int iterations) {
    for (const double step : options_.steps) {
      const Bed bed = make_bed(options_.grains, exponent, 1);
      write(method.name, exponent, iterations, pour(method, bed, {step, iterations}, options_.duration));
    }
  }

  void write(const std::string& method, double exponent, int iterations, const Outcome& o) {
    std::printf("| %d, %g | %s | %d | %g | %.1e | %.1e | %.2f |\n", options_.grains, exponent, method.c_str(), iterations,
                1e3 * o.step, o.deepest, o.mean, o.seconds);
    std::fflush(stdout);
    if (!csv_.is_open()) return;
    csv_ << method << ',' << options_.grains << ',' << exponent << ',' << iterations << ',' << o.step << ',' << o.deepest << ','
         << o.mean << ',' << o.seconds << std::endl;
  }

  const Options& options_;
  std::ofstream csv_;
};

void run(const Options& options) {
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  Beds(options).run();
  snClose();
  dCloseODE();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    CLI::App app("What contacts before overlap save in a bed of grains");
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    app.add_option("--methods", options.methods, "plain, ahead, Bullet (with libbullet-dev; exponent 2)")
        ->check(CLI::IsMember(names))
        ->delimiter(',');
    app.add_option("--grains", options.grains, "in the bed")->check(CLI::Range(1, 100000))->capture_default_str();
    app.add_option("--exponents", options.exponents, "of the grains, above 1")->delimiter(',');
    app.add_option("--steps", options.steps, "s")->check(CLI::Range(1e-6, 1.0))->delimiter(',');
    app.add_option("--iterations", options.iterations, "of the solver")->check(CLI::Range(1, 100000))->delimiter(',');
    app.add_option("--duration", options.duration, "s")->check(CLI::Range(0.01, 1000.0))->capture_default_str();
    app.add_option("--csv", options.csv, "file to which the results are added");
    CLI11_PARSE(app, argc, argv);
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "look_ahead_beds: %s\n", error.what());
    return 1;
  }
  return 0;
}
