// What an answer promises, on fresh random pairs of every kind: the proof where the bodies are apart, touch or overlap by less than
// the ball that rolls inside them; deeper the interval, and seldom a missed maximum.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "proximity/collider_reference.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/draw.hpp"
#include "support/random_bodies.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

const int kProvedPairs = draws(600);  // of each kind
constexpr int kDeepPairs = 1500;      // of each kind; a share of one in five hundred takes so many
constexpr double kDeepest = 0.3;      // of the smallest half-extent
constexpr double kMissed = 1e-6;      // of the same
constexpr double kMissedShare = 0.002;
constexpr int kReferenced = 15;  // of each kind: deep pairs beside a branch and bound, which is independent of the solvers

std::string describe(const RandomKind& kind, int k, const Proximity& answer, double known) {
  return kind.name + " " + std::to_string(k) + ": gap " + std::to_string(answer.gap) + " off by " +
         std::to_string((answer.gap - known) * 1e12) + " pm, status " + std::to_string(static_cast<int>(answer.status)) +
         (answer.is_global ? ", global, " : ", not global, ") + std::to_string(answer.evaluations) + " evaluations";
}

GapFunction gap_of(const RandomPair& pair) { return {*pair.shape1, {}, *pair.shape2, pair.pose2}; }

/// The gap belongs to the normal, and the witness points are on both boundaries, a gap apart.
Proximity solve(const RandomPair& pair, const Settings& settings = {}) {
  const Traps traps("contract of an answer");
  const Proximity answer = find_proximity(*pair.shape1, {}, *pair.shape2, pair.pose2, settings);
  GapFunction gap = gap_of(pair);
  const double rounding = 4 * gap.rounding();
  GapJet jet;
  gap.evaluate(answer.normal, Order::Value, jet);
  CHECK(std::abs(jet.s - answer.gap) <= rounding);
  CHECK(std::abs(answer.normal.norm() - 1) <= 4e-16);
  CHECK(std::abs(answer.normal.dot(answer.point1) - pair.shape1->support(answer.normal)) <= rounding);
  CHECK(std::abs(answer.normal.dot(answer.point2 - answer.point1) - answer.gap) <= rounding);
  CHECK(answer.contact.allFinite());
  return answer;
}

Proximity certified(const RandomPair& pair) {
  return solve(pair, {.tolerance = 0.1 * kMissed, .max_evaluations = 5000, .certify_depth = true});
}

/// A gap that is proved, in m: apart, touching, or within the ball that rolls inside, from rounding to the unit of length.
double proved_gap(RandomBodies& bodies, const RandomPair& pair, int k) {
  switch (k % 4) {
    case 0:
      return 0;
    case 1:
      return pair.unit * bodies.uniform(0, 1);
    case 2:
      return -pair.rolling_radius() * bodies.uniform(0, 0.999);  // touching where no ball rolls
    default:
      return pair.unit * bodies.log_uniform(1e-12, 1);
  }
}

/// No digit of the placed gap is the solver's: at such a gap the bodies' witness points at the normal prove it.
void check_proved(const RandomKind& kind, int k, const RandomPair& pair) {
  const Proximity answer = solve(pair);
  const double allowed = Settings{}.tolerance * pair.unit + 4 * gap_of(pair).rounding();
  const std::string text = describe(kind, k, answer, pair.placed);
  CHECK_MESSAGE(answer.status == Status::Converged, text);
  CHECK_MESSAGE(answer.is_global, text);
  CHECK_MESSAGE(std::abs(answer.gap - pair.placed) <= allowed, text);
  CHECK_MESSAGE(answer.gap + answer.global_error >= pair.placed - 4 * gap_of(pair).rounding(), text);
  CHECK_MESSAGE(answer.global_error <= allowed, text);
}

struct Missed {
  int pairs = 0, missed = 0, unproved = 0, unconverged = 0;
  double worst = 0;  // of the unit
};

void check_deep(const RandomKind& kind, int k, const RandomPair& pair, Missed& out) {
  const Proximity answer = solve(pair), best = certified(pair);
  const double rounding = 4 * gap_of(pair).rounding();
  const double known = std::max(best.gap, pair.placed);
  CHECK_MESSAGE(known <= answer.gap + answer.global_error + rounding, describe(kind, k, answer, known));
  CHECK_MESSAGE(answer.gap <= best.gap + best.global_error + rounding, describe(kind, k, answer, known));
  const double miss = (known - answer.gap) / pair.unit;
  ++out.pairs;
  out.missed += miss > kMissed;
  out.worst = std::max(out.worst, miss);
  out.unproved += !best.is_global;
  const Proximity swapped = find_proximity(*pair.shape2, pair.pose2, *pair.shape1, {});
  CHECK_MESSAGE(swapped.gap <= answer.gap + answer.global_error + rounding, describe(kind, k, answer, known));
  CHECK_MESSAGE(answer.gap <= swapped.gap + swapped.global_error + rounding, describe(kind, k, answer, known));
  if (k < kReferenced) {
    const GapBounds bounds = bound_gap(*pair.shape1, {}, *pair.shape2, pair.pose2, 1e-9 * pair.unit);
    CHECK_MESSAGE(best.gap <= bounds.upper + rounding, describe(kind, k, best, bounds.upper));
    CHECK_MESSAGE(bounds.lower <= best.gap + best.global_error + rounding, describe(kind, k, best, bounds.lower));
  }
  out.unconverged += answer.status != Status::Converged;
}

std::vector<RandomKind> all_kinds() {
  std::vector<RandomKind> kinds = random_kinds();
  for (const RandomKind& kind : composed_kinds()) kinds.push_back(kind);
  return kinds;
}

}  // namespace

TEST_CASE("apart, touching, or overlapping by less than the ball that rolls inside: converged, proved, within the tolerance") {
  for (const RandomKind& kind : all_kinds()) {
    RandomBodies bodies(kind, 91);
    for (int k = 0; k < kProvedPairs; ++k) {
      RandomPair pair = bodies.draw_apart();
      bodies.place(pair, proved_gap(bodies, pair, k));
      check_proved(kind, k, pair);
    }
  }
}

TEST_CASE("deep overlaps: the interval holds for every pair, and one in five hundred at most misses the maximum") {
  for (const RandomKind& kind : all_kinds()) {
    RandomBodies bodies(kind, 92);
    Missed out;
    for (int k = 0; k < kDeepPairs; ++k) check_deep(kind, k, bodies.draw(bodies.uniform(-kDeepest, 0)), out);
    MESSAGE(kind.name, ": ", out.missed, " of ", out.pairs, " missed, by up to ", out.worst, " of the unit; ", out.unproved,
            " without a proof of the maximum, ", out.unconverged, " not converged");
    CHECK(out.missed <= kMissedShare * out.pairs);
  }
}

TEST_CASE("a followed normal is left for one of a depth that is less by more than a sixth") {
  const int pairs = draws(150);    // of each kind, half of them shallow
  constexpr double kGain = 0.17;   // Tuning::leaving_gain
  constexpr double kLooks = 0.02;  // of the unit, Tuning::unsearched_depth
  int followed = 0;
  for (const RandomKind& kind : random_kinds()) {
    RandomBodies bodies(kind, 93);
    for (int k = 0; k < pairs; ++k) {
      const RandomPair pair = bodies.draw(k % 2 == 0 ? bodies.uniform(-1, -0.1) : bodies.uniform(-0.2, -0.02));
      const Vector3 first = bodies.draw_apart().pose2.rotation.col(0);
      const Proximity answer = find_proximity(*pair.shape1, {}, *pair.shape2, pair.pose2, {}, &first);
      if (-answer.gap < kLooks * pair.unit || answer.evaluations >= 200) continue;
      const Proximity best = find_proximity(*pair.shape1, {}, *pair.shape2, pair.pose2, {.certify_depth = true});
      ++followed;
      CAPTURE(kind.name);
      CAPTURE(k);
      CHECK(best.gap <= (1 - kGain) * answer.gap + 1e-9 * pair.unit);
    }
  }
  CHECK(followed > draws(2400));
}
