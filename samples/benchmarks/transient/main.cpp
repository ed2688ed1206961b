// The experiment of the paper: superellipsoids thrown into each other and into a box, with every method as the narrow phase of the
// same world.

#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "trial.hpp"

namespace {

using namespace transient;
using accuracy_cost::BodyClass;

constexpr std::size_t kMoments = 100;  // moments of a motion, in its file

struct NamedClass {
  const char* name;
  BodyClass body_class;
};
constexpr std::array kClasses = {NamedClass{"E", BodyClass::Ellipsoid}, NamedClass{"M", BodyClass::Moderate},
                                 NamedClass{"B", BodyClass::Boxy}, NamedClass{"N", BodyClass::Needle}};

struct Options {
  std::vector<int> bodies = {8, 64};
  std::vector<double> steps = {1e-3, 5e-3};
  std::vector<std::string> methods;
  double duration = 1;  // s
  unsigned long long seed = 1;
  std::string csv = "transient.csv", motion;
};

class Study {
 public:
  explicit Study(const Options& options) : options_(options), contestants_(contestants()) {
    open(options.csv, csv_,
         "same_queries,same_seconds,same_evaluations,same_failed,same_wrong,same_missed,same_invented,same_undecided,"
         "own_queries,own_failed,parted_s,duration_s,seed\n");
    if (!options.motion.empty()) open(options.motion, motion_, "time_s,distance,seed\n");
  }

  void run() {
    for (const auto& [name, body_class] : kClasses) {
      for (const int bodies : options_.bodies) {
        for (const bool has_friction : {false, true}) {
          for (const double step : options_.steps) {
            if (options_.duration < step) {
              throw std::invalid_argument("--duration is " + std::to_string(options_.duration) + " s; allowed: a step or more, " +
                                          std::to_string(step) + " s");
            }
            run_all(name, {{body_class, bodies, has_friction, step, options_.seed}, options_.duration});
          }
        }
      }
    }
  }

 private:
  static void open(const std::string& path, std::ofstream& file, const char* columns) {
    file.open(path, std::ios::app);
    file.precision(15);  // counts have all their digits
    if (!file) throw std::runtime_error("cannot write " + path);
    if (file.tellp() == 0) file << "class,bodies,contacts,step_s,method,start," << columns;
  }

  void run_all(const std::string& body_class, const Trial& trial) {
    Path certified;
    const Contestant& reference = contestants_.front();
    write(body_class, trial, reference, "", watch(trial, reference), transient::run(trial, reference, false, nullptr, &certified));
    write(body_class, trial, reference, " moved by 1e-12 m", {}, transient::run(trial, reference, true, &certified, nullptr));
    for (std::size_t k = 1; k < contestants_.size(); ++k) {
      const Contestant& contestant = contestants_[k];
      const bool is_wanted =
          options_.methods.empty() || std::ranges::find(options_.methods, contestant.name) != options_.methods.end();
      if (!is_wanted) continue;
      write(body_class, trial, contestant, "", watch(trial, contestant),
            transient::run(trial, contestant, false, &certified, nullptr));
    }
  }

  void write(const std::string& body_class, const Trial& trial, const Contestant& contestant, const char* addition,
             const Outcome& same, const Outcome& own) {
    const Setup& setup = trial.setup;
    const auto add_key = [&](std::ofstream& file) -> std::ofstream& {
      file << body_class << ',' << setup.bodies << ',' << (setup.has_friction ? "friction" : "elastic") << ',' << setup.step << ','
           << contestant.name << addition << ',' << contestant.start << ',';
      return file;
    };
    const std::size_t between = std::max<std::size_t>(1, own.distances.size() / kMoments);
    for (std::size_t k = between - 1; motion_.is_open() && k < own.distances.size(); k += between) {
      add_key(motion_) << static_cast<double>(k + 1) * setup.step << ',' << own.distances[k] << ',' << setup.seed << '\n';
    }
    add_key(csv_) << same.queries << ',' << same.seconds << ',' << same.evaluations << ',' << same.failed << ',' << same.wrong
                  << ',' << same.missed << ',' << same.invented << ',' << same.undecided << ',' << own.queries << ',' << own.failed
                  << ',' << own.parted << ',' << trial.duration << ',' << setup.seed << std::endl;
  }

  const Options& options_;
  const std::vector<Contestant> contestants_;
  std::ofstream csv_, motion_;
};

void run(const Options& options) {
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  Study(options).run();
  snClose();
  dCloseODE();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    CLI::App app("Superellipsoids that collide, with every method as the narrow phase of the same world");
    std::vector<std::string> names;
    for (const Contestant& contestant : contestants()) {
      if (std::ranges::find(names, contestant.name) == names.end()) names.push_back(contestant.name);  // one name for cold and warm
    }
    app.add_option("--bodies", options.bodies, "in a world")->check(CLI::Range(1, 100000))->delimiter(',')->default_str("8,64");
    app.add_option("--steps", options.steps, "s")->check(CLI::Range(1e-6, 0.1))->delimiter(',')->default_str("0.001,0.005");
    app.add_option("--methods", options.methods, "names in the file; all without it")->check(CLI::IsMember(names))->delimiter(';');
    app.add_option("--duration", options.duration, "s")->check(CLI::Range(1e-3, 1000.0))->capture_default_str();
    app.add_option("--seed", options.seed, "of the bodies and their start")->capture_default_str();
    app.add_option("--csv", options.csv, "file to which the results are added")->capture_default_str();
    app.add_option("--motion", options.motion, "file to which the distances from the certified motion are added");
    CLI11_PARSE(app, argc, argv);
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "transient: %s\n", error.what());
    return 1;
  }
  return 0;
}
