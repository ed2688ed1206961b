// Tests whether bodies come to rest as well as a dBox or a dCylinder of their size, at any step, floor, size and max_contacts.
// Drops each body 24 times. Prints every row that is worse than its counterpart's, then their number.

#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "drop.hpp"

using namespace resting;

namespace {

// A row is as good as the counterpart's row if three conditions hold. As many bodies fall asleep. They take at most twice the time.
// No body sinks into the floor if the counterpart's does not. For rolling bodies only the last condition counts, because their
// sleep is random.
constexpr double kSlower = 2;
// Half-heights. If the counterpart itself comes to rest lower, the limit is its height less a hundredth.
constexpr double kHeld = -0.1;
constexpr double kSlack = 0.01;

const std::map<std::string, FloorKind> kFloors = {{"plane", FloorKind::Plane},
                                                  {"box", FloorKind::Box},
                                                  {"mesh", FloorKind::Mesh},
                                                  {"heightfield", FloorKind::Heightfield},
                                                  {"ours", FloorKind::Superellipsoid}};

struct Options {
  std::vector<std::string> floors = {"plane", "box", "mesh", "heightfield", "ours"};
  std::vector<std::string> bodies = {"brick"};
  std::vector<double> exponents = {8, 12, 20, 60, 200};
  std::vector<double> half_heights = {0.001, 0.01, 0.05, 0.25, 1};
  std::vector<double> steps = {0.002, 0.005, 0.01, 0.0167, 0.02, 0.05};
  std::vector<int> rooms = {3, 4, 8};
  std::vector<double> correcting_velocities = {0, 0.1};
  Orientations orientations;
  bool looks_ahead = false;
  bool prints_all = false;
};

/// The outcome of all drops of a row.
struct Summary {
  int asleep = 0;
  double median = 0;   ///< s; bodies that never sleep count with the whole time
  double highest = 0;  ///< height of the highest centre of the sleeping bodies, half-heights
  double lowest = 0;   ///< height of the lowest point of all bodies at the end, half-heights
};

Summary summarise(const Row& row, const Orientations& orientations) {
  Summary summary;
  summary.lowest = HUGE_VAL;
  std::vector<double> times;
  for (int number = 0; number < kDrops; ++number) {
    const Rest rest = drop(row, orientations, number);
    summary.asleep += rest.is_asleep ? 1 : 0;
    if (rest.is_asleep) summary.highest = std::max(summary.highest, rest.height);
    summary.lowest = std::min(summary.lowest, rest.lowest);
    times.push_back(rest.time);
  }
  std::nth_element(times.begin(), times.begin() + kDrops / 2, times.end());
  summary.median = times[kDrops / 2];
  return summary;
}

bool is_as_good(const Summary& ours, const Summary& counterpart, bool rolls) {
  const bool is_held = ours.lowest >= std::min(kHeld, counterpart.lowest - kSlack);
  const bool rests = ours.asleep >= counterpart.asleep && ours.median <= kSlower * counterpart.median;
  return is_held && (rolls || rests);
}

/// How deep the bodies of all rows are in the floor at the end, and how high they stand.
class Heights {
 public:
  void add(const Summary& summary) {
    const double overlap = -summary.lowest;
    for (std::size_t k = 0; k < kLimits.size(); ++k) deeper_[k] += overlap > kLimits[k] ? 1 : 0;
    raised_ += summary.highest > 1 + kRaised ? 1 : 0;
    deepest_ = std::max(deepest_, overlap);
  }

  void print(const char* name) const {
    std::printf("%s: rows with an overlap at the end above", name);
    for (std::size_t k = 0; k < kLimits.size(); ++k) std::printf(" %g: %d;", kLimits[k], deeper_[k]);
    std::printf(" deepest %.3g half-heights; asleep more than %g too high: %d\n", deepest_, kRaised, raised_);
  }

 private:
  static constexpr std::array<double, 3> kLimits = {1e-3, 1e-2, 0.1};  // half-heights
  static constexpr double kRaised = 0.01;                              // half-heights
  std::array<int, kLimits.size()> deeper_{};
  int raised_ = 0;
  double deepest_ = 0;
};

std::vector<std::string> names_of_bodies() {
  std::vector<std::string> names;
  for (const BodyKind& kind : body_kinds()) names.emplace_back(kind.name);
  return names;
}

class Matrix {
 public:
  explicit Matrix(const Options& options) : options_(options) {}

  /// Returns how many rows are worse.
  int run() {
    std::printf(
        "body, floor, half-height m, step s, room, correcting m/s, exponent: asleep, median s, highest, lowest (counterpart)\n");
    for (const BodyKind& kind : body_kinds()) {
      if (std::find(options_.bodies.begin(), options_.bodies.end(), kind.name) != options_.bodies.end()) run(kind);
    }
    ours_.print("ours");
    counterparts_.print("dBox or dCylinder");
    std::printf("%d of %d rows are worse than those of a dBox or dCylinder\n", worse_, rows_);
    return worse_;
  }

 private:
  void run(const BodyKind& kind) {
    for (const std::string& floor : options_.floors) {
      for (const double half_height : options_.half_heights) {
        for (const double step : options_.steps) {
          for (const double velocity : options_.correcting_velocities) {
            for (const int room : options_.rooms) {
              compare(floor, {kFloors.at(floor), kind, 0, half_height, step, room, velocity, options_.looks_ahead});
            }
          }
        }
      }
    }
  }

  void compare(const std::string& floor, Row row) {
    const Summary box = summarise(row, options_.orientations);
    const std::vector<double> none = {HUGE_VAL};
    for (const double exponent : row.kind.has_exponent() ? options_.exponents : none) {
      row.exponent = exponent;
      const Summary ours = summarise(row, options_.orientations);
      const bool is_good = is_as_good(ours, box, row.kind.lies_on_its_side());
      ++rows_;
      ours_.add(ours);
      counterparts_.add(box);
      worse_ += is_good ? 0 : 1;
      if (is_good && !options_.prints_all) continue;
      std::printf("%-13s %-11s %5.3f %6.4f %d %3.1f %3.0f: %2d %6.3f %6.3f %6.3f (%2d %6.3f %6.3f %6.3f)%s\n", row.kind.name,
                  floor.c_str(), row.half_height, row.step, row.room, row.correcting_velocity, exponent, ours.asleep, ours.median,
                  ours.highest, ours.lowest, box.asleep, box.median, box.highest, box.lowest, is_good ? "" : " worse");
      std::fflush(stdout);
    }
  }

  const Options& options_;
  Heights ours_;
  Heights counterparts_;
  int rows_ = 0;
  int worse_ = 0;
};

int run(const Options& options) {
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  const int worse = Matrix(options).run();
  snClose();
  dCloseODE();
  return worse == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    CLI::App app("Whether bodies come to rest as a dBox or a dCylinder does; exit status 1 if some do not");
    app.add_option("--floors", options.floors, "plane, box, mesh, heightfield, ours")
        ->check(CLI::IsMember(kFloors))
        ->delimiter(',');
    app.add_option("--bodies", options.bodies, "the kinds in drop.hpp")->check(CLI::IsMember(names_of_bodies()))->delimiter(',');
    app.add_option("--exponents", options.exponents, "of the bodies")->delimiter(',');
    app.add_option("--half-heights", options.half_heights, "m")->delimiter(',');
    app.add_option("--steps", options.steps, "s")->delimiter(',');
    app.add_option("--rooms", options.rooms, "contacts a pair, 1 to 8")->check(CLI::Range(1, 8))->delimiter(',');
    app.add_option("--correcting-velocities", options.correcting_velocities, "m/s; 0: without limit")->delimiter(',');
    app.add_option("--draw", options.orientations.draw, "another number drops them in other orientations");
    app.add_option("--largest-tilt", options.orientations.largest_tilt, "degrees, 1 to 90")->check(CLI::Range(1, 90));
    app.add_flag("--look-ahead", options.looks_ahead, "give our bodies contacts before they overlap, and the counterparts none");
    app.add_flag("--all", options.prints_all, "print the other rows, too");
    CLI11_PARSE(app, argc, argv);
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "resting: %s\n", error.what());
    return 1;
  }
}
