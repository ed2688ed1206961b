#include "comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iterator>
#include <limits>

namespace supernormal::impact_hosts {
namespace {

constexpr int kPairs = 1000;
constexpr int kRuns = 5;
constexpr double kDeep = 1e-6;  // m; a deeper overlap is more than a host's rounding

// rad; the second one is below the quarter of a half-turn into which Bullet cuts each motion.
constexpr double kTurns[] = {0, 0.75, 2};

const char* name_of(Bodies bodies) {
  constexpr const char* kNames[] = {"balls, boxes, capsules, cylinders", "ellipsoids", "superellipsoids"};
  return kNames[static_cast<std::size_t>(bodies)];
}

/// s; the processor time of this process so far. std::clock is too coarse for one search.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Tally {
  int impacts = 0, missed = 0, late = 0, invented = 0;
  double seconds = 0;          // s; of all pairs
  double sum = 0, widest = 0;  // m; sum and maximum of the gaps at the times found

  int found() const { return impacts - missed; }

  void judge(double time, const MovingPair& pair, const Impact& truth) {
    if (!truth.may_hit()) {
      if (time <= kHorizon) ++invented;
      return;
    }
    ++impacts;
    if (time > kHorizon) {
      ++missed;
      return;
    }
    const double gap = std::abs(pair.gap(time));
    sum += gap;
    widest = std::max(widest, gap);
    // Until the true time the bodies are proved apart.
    double deepest = 0;
    for (int k = 0; k <= 100 && time > truth.time; ++k) {
      deepest = std::min(deepest, pair.gap(truth.time + (time - truth.time) * k / 100));
    }
    if (deepest < -kDeep) ++late;
  }

  void print(const std::string& name) const {
    std::printf("  %-28s %7.2f us; missed %3d, late %3d, invented %3d; gap then %.1e m, at most %.1e m\n", name.c_str(),
                1e6 * seconds / kPairs, missed, late, invented, sum / std::max(found(), 1), widest);
  }
};

Contestant ours(const std::string& name, double tolerance) {
  return {name, [tolerance](const MovingPair& pair) {
            return [&pair, settings = Settings{.tolerance = tolerance}] {
              const Impact impact = pair.impact(settings);
              return impact.may_hit() ? impact.time : kNoImpact;
            };
          }};
}

/// Runs all searches for the impact of a pair.
void run(const std::vector<Contestant>& contestants, const MovingPair& pair, std::vector<Tally>& tallies) {
  std::vector<std::function<double()>> searches;
  searches.reserve(contestants.size());
  for (const Contestant& contestant : contestants) searches.push_back(contestant.prepare(pair));
  std::vector<double> times(searches.size());
  std::vector<double> least(searches.size(), std::numeric_limits<double>::infinity());
  for (int run = 0; run < kRuns; ++run) {
    for (std::size_t k = 0; k < searches.size(); ++k) {
      const double start = processor_time();
      times[k] = searches[k]();
      least[k] = std::min(least[k], processor_time() - start);
    }
  }
  const Impact truth = pair.impact({.tolerance = 1e-12});
  for (std::size_t k = 0; k < searches.size(); ++k) {
    tallies[k].seconds += least[k];
    tallies[k].judge(times[k], pair, truth);
  }
}

/// Compares on one kind of bodies and motion.
bool compare(Bodies bodies, double most_turn, const std::vector<Contestant>& contestants) {
  RandomPairs random;
  std::vector<Tally> tallies(contestants.size());
  for (int k = 0; k < kPairs; ++k) run(contestants, random.draw(bodies, most_turn), tallies);
  const Tally& exact = tallies.front();
  std::printf("%s, turning by up to %g rad: %d impacts\n", name_of(bodies), most_turn, exact.impacts);
  bool is_right = exact.impacts > kPairs / 10 && exact.missed + exact.late + exact.invented == 0 && exact.widest < 1e-8;
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    tallies[k].print(contestants[k].name);
    if (most_turn == 0) is_right = is_right && 2 * tallies[k].found() > tallies[k].impacts;
  }
  return is_right;
}

}  // namespace

bool compare(std::span<const Bodies> kinds, const std::vector<Contestant>& host) {
  bool is_right = true;
  for (const Bodies bodies : kinds) {
    for (const double most_turn : kTurns) {
      std::vector<Contestant> contestants = {ours("ours, 1e-9", 1e-9), ours("ours, 2e-3", 2e-3)};
      std::copy_if(host.begin(), host.end(), std::back_inserter(contestants),
                   [&](const Contestant& contestant) { return most_turn == 0 || contestant.follows_turns; });
      is_right = compare(bodies, most_turn, contestants) && is_right;
    }
  }
  return is_right;
}

}  // namespace supernormal::impact_hosts
