// The experiment of the paper: superellipsoids thrown into each other and into a box, with every method as the narrow phase of the
// same world.

#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
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

struct Options {
  std::vector<std::string> classes = {"E", "M", "B", "N"};
  std::vector<int> bodies = {8, 64};
  std::vector<double> steps = {1e-3, 5e-3};
  std::vector<std::string> contacts = {"elastic", "friction"};
  std::vector<std::string> methods;
  double duration = 1;  // s
  unsigned long long seed = 1;
  std::string csv, motion;
};

BodyClass class_of(const std::string& name) {
  return name == "E" ? BodyClass::Ellipsoid : name == "M" ? BodyClass::Moderate : name == "B" ? BodyClass::Boxy : BodyClass::Needle;
}

class Study {
 public:
  explicit Study(const Options& options) : options_(options), contestants_(contestants()) {
    open(options.csv, csv_);
    open(options.motion, motion_);
    if (motion_.is_open() && motion_.tellp() == 0) motion_ << "class,bodies,contacts,step_s,method,start,time_s,distance,seed\n";
    if (!csv_.is_open() || csv_.tellp() > 0) return;
    csv_ << "class,bodies,contacts,step_s,method,start,same_queries,same_warm,same_seconds,same_evaluations,same_failed,same_wrong,"
            "same_missed,same_invented,same_undecided,own_queries,own_warm,own_seconds,own_evaluations,own_failed,energy_drift,"
            "momentum_drift,parted_s,duration_s,seed\n";
  }

  void run() {
    for (const std::string& body_class : options_.classes) {
      for (const int bodies : options_.bodies) {
        for (const std::string& contacts : options_.contacts) {
          for (const double step : options_.steps) {
            if (options_.duration < step) {
              throw std::invalid_argument("--duration is " + std::to_string(options_.duration) + " s; allowed: a step or more, " +
                                          std::to_string(step) + " s");
            }
            const Setup setup{class_of(body_class), bodies, contacts == "friction", step, options_.seed};
            run_all(body_class, contacts, {setup, options_.duration});
          }
        }
      }
    }
  }

 private:
  static void open(const std::string& path, std::ofstream& file) {
    if (path.empty()) return;
    file.open(path, std::ios::app);
    file.precision(15);  // counts have all their digits
    if (!file) throw std::runtime_error("cannot write " + path);
  }

  void run_all(const std::string& body_class, const std::string& contacts, const Trial& trial) {
    std::printf(
        "\n%s, %d bodies, %s, steps of %g ms, %g s\n\n"
        "| method | start | same poses: us a query | same: evaluations a query | same: evaluations a step | same: failed, 1e-6 "
        "| same: wrong, 1e-6 | same: missed, 1e-6 | same: invented, 1e-6 "
        "| own world: failed, 1e-6 | own: energy drift | own: momentum drift | own: parted, s |\n"
        "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        body_class.c_str(), trial.setup.bodies, contacts.c_str(), 1e3 * trial.setup.step, trial.duration);
    Path certified;
    const Contestant& reference = contestants_.front();
    write(body_class, contacts, trial, reference, "", watch(trial, reference),
          transient::run(trial, reference, false, nullptr, &certified));
    write(body_class, contacts, trial, reference, " moved by 1e-12 m", {},
          transient::run(trial, reference, true, &certified, nullptr));
    for (std::size_t k = 1; k < contestants_.size(); ++k) {
      const Contestant& contestant = contestants_[k];
      const bool is_wanted =
          options_.methods.empty() || std::ranges::find(options_.methods, contestant.name) != options_.methods.end();
      if (!is_wanted) continue;
      write(body_class, contacts, trial, contestant, "", watch(trial, contestant),
            transient::run(trial, contestant, false, &certified, nullptr));
    }
  }

  void write(const std::string& body_class, const std::string& contacts, const Trial& trial, const Contestant& contestant,
             const char* addition, const Outcome& same, const Outcome& own) {
    const auto per = [](double part, unsigned long long whole) { return whole == 0 ? 0 : part / static_cast<double>(whole); };
    const double steps = std::round(trial.duration / trial.setup.step);
    const auto cell = [](const char* format, double value, bool has_value) {
      std::array<char, 40> text{};
      std::snprintf(text.data(), text.size(), has_value ? format : "", value);
      std::printf(" | %s", text.data());
    };
    std::printf("| %s%s | %s", contestant.name.c_str(), addition, contestant.start.c_str());
    const bool is_asked = same.queries > 0, is_elastic = !trial.setup.has_friction;
    cell("%.2f", 1e6 * per(same.seconds, same.queries), is_asked);
    cell("%.1f", per(same.evaluations, same.queries), is_asked && same.evaluations > 0);
    cell("%.0f", same.evaluations / steps, is_asked && same.evaluations > 0);
    for (const unsigned long long count : {same.failed, same.wrong, same.missed, same.invented}) {
      cell("%.0f", 1e6 * per(static_cast<double>(count), same.queries), is_asked);
    }
    cell("%.0f", 1e6 * per(static_cast<double>(own.failed), own.queries), true);
    cell("%.1e", own.energy_drift, is_elastic);
    cell("%.1e", own.momentum_drift, is_elastic);
    cell("%.3f", own.parted, std::isfinite(own.parted));
    std::printf(" |\n");
    std::fflush(stdout);
    const auto add_key = [&](std::ofstream& file) {
      file << body_class << ',' << trial.setup.bodies << ',' << contacts << ',' << trial.setup.step << ',' << contestant.name
           << addition << ',' << contestant.start;
    };
    const std::size_t between = std::max<std::size_t>(1, own.distances.size() / kMoments);
    for (std::size_t k = between - 1; motion_.is_open() && k < own.distances.size(); k += between) {
      add_key(motion_);
      motion_ << ',' << static_cast<double>(k + 1) * trial.setup.step << ',' << own.distances[k] << ',' << trial.setup.seed << '\n';
    }
    if (!csv_.is_open()) return;
    add_key(csv_);
    for (const Outcome* o : {&same, &own}) {
      csv_ << ',' << o->queries << ',' << o->warm_queries << ',' << o->seconds << ',' << o->evaluations << ',' << o->failed;
      if (o == &same) csv_ << ',' << o->wrong << ',' << o->missed << ',' << o->invented << ',' << o->undecided;
    }
    csv_ << ',' << own.energy_drift << ',' << own.momentum_drift << ',' << own.parted << ',' << trial.duration << ','
         << trial.setup.seed << std::endl;
  }

  const Options& options_;
  const std::vector<Contestant> contestants_;
  std::ofstream csv_, motion_;
};

void run(const Options& options) {
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  {
    Study study(options);
    study.run();
  }
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
    app.add_option("--classes", options.classes, "E (ellipsoids), M (exponents 1.3 to 5), B (6 to 20), N (needles)")
        ->check(CLI::IsMember(std::vector<std::string>{"E", "M", "B", "N"}))
        ->delimiter(',')
        ->default_str("E,M,B,N");
    app.add_option("--bodies", options.bodies, "in a world")->check(CLI::Range(1, 100000))->delimiter(',')->default_str("8,64");
    app.add_option("--contacts", options.contacts, "elastic, friction")
        ->check(CLI::IsMember(std::vector<std::string>{"elastic", "friction"}))
        ->delimiter(',')
        ->default_str("elastic,friction");
    app.add_option("--steps", options.steps, "s")->check(CLI::Range(1e-6, 0.1))->delimiter(',')->default_str("0.001,0.005");
    app.add_option("--methods", options.methods, "names in the table; all without it")->check(CLI::IsMember(names))->delimiter(';');
    app.add_option("--duration", options.duration, "s")->check(CLI::Range(1e-3, 1000.0))->capture_default_str();
    app.add_option("--seed", options.seed, "of the bodies and their start")->capture_default_str();
    app.add_option("--csv", options.csv, "file to which the results are added");
    app.add_option("--motion", options.motion, "file to which the distances from the certified motion are added");
    CLI11_PARSE(app, argc, argv);
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "transient: %s\n", error.what());
    return 1;
  }
  return 0;
}
