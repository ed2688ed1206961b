// The kinds of random pairs that ask one query of the library, beside a slow reference or the placed gap.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "impact/random_motions.hpp"
#include "pairs/kinds.hpp"
#include "proximity/derivatives/comparison.hpp"
#include "supernormal/proximity/clearance.hpp"
#include "support/random_bodies.hpp"

namespace supernormal::test {
namespace {

struct Count {
  int pairs = 0;
  double evaluations = 0;

  void add(int count) {
    ++pairs;
    evaluations += count;
  }
  double mean() const { return pairs > 0 ? evaluations / pairs : 0; }
};

struct Distances {
  double least_gap, largest_gap;  // smallest half-extents
  double distance;                // gaps
  Count cold = {}, warm = {};
};

}  // namespace

/// is_farther_than() for pairs of all kinds. Their gap is known from the normal at which they were placed.
void run_clearances(const Draws& draws, Report& report) {
  std::vector<Distances> rows = {{0.5, 8, 0.5},       {0.5, 8, 0.2},  {0.02, 0.5, 0.5}, {0.02, 8, 0.99},
                                 {0.02, 8, 1 + 1e-6}, {0.02, 8, 1.5}, {0.02, 8, 4}};
  const std::vector<RandomKind> kinds = random_kinds();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    RandomBodies bodies(kinds[i], static_cast<unsigned>(draws.seed + i));
    const std::size_t count = draws.count / kinds.size() + (i < draws.count % kinds.size());
    for (std::size_t k = 0; k < count; ++k) {
      Distances& row = rows[k % rows.size()];
      const RandomPair pair = bodies.draw(bodies.uniform(row.least_gap, row.largest_gap));
      const double distance = row.distance * pair.placed;
      Vector3 normal = Vector3::Zero();
      for (Count* const answers : {&row.cold, &row.warm}) {
        int evaluations = 0;
        const bool is_farther = is_farther_than(*pair.shape1, {}, *pair.shape2, pair.pose2, distance, &normal, &evaluations);
        if (is_farther != (row.distance < 1)) report.fault(kinds[i].name + ", pair " + std::to_string(k));
        answers->add(evaluations);
      }
    }
  }
  report.head({"gap, smallest half-extents", "distance, gaps", "pairs", "evaluations, cold", "with the last normal"});
  for (const Distances& row : rows) {
    std::ostringstream gaps;
    gaps << row.least_gap << " to " << row.largest_gap;
    report.row(gaps.str(), {row.distance, static_cast<double>(row.cold.pairs), row.cold.mean(), row.warm.mean()});
  }
}

/// Derivatives beside differences in long double, and gradients of flat pairs beside differences.
void run_derivatives(const Draws& draws, Report& report) {
  static constexpr const char* kStatuses[] = {"smooth",         "active set", "degenerate",    "free on a face", "singular",
                                              "several maxima", "no Hessian", "not converged", "invalid"};
  DerivativePairs pairs(static_cast<unsigned>(draws.seed));
  Tally tally;
  for (std::uint64_t k = 0; k < draws.count; ++k) compare(pairs.draw(), std::to_string(k), tally);
  report.head({"pairs", "number"});
  for (const auto& [status, count] : tally.statuses) report.row(kStatuses[static_cast<int>(status)], {double(count)});
  report.row("beyond the reference", {double(tally.unreferenced)});
  report.row("evaluations, each", {tally.evaluations / static_cast<double>(tally.pairs)});
  report.head({"quantity", "compared", "undecided", "wrong", "largest relative error"});
  for (std::size_t k = 0; k < QuantityCount; ++k) {
    const Tally::Figures& f = tally.figures[k];
    report.row(kQuantityNames[k], {double(f.compared), double(f.undecided), double(f.wrong), f.worst});
    for (int i = 0; i < f.wrong; ++i) report.fault(kQuantityNames[k]);
  }
  if (tally.not_finite > 0) report.fault(std::to_string(tally.not_finite) + " pairs have numbers that are not finite");
  std::printf("%s", tally.first_wrong.c_str());
}

void run_flat_derivatives(const Draws& draws, Report& report) {
  DerivativePairs pairs(static_cast<unsigned>(draws.seed));
  FlatTally tally;
  for (std::uint64_t k = 0; k < draws.count; ++k) compare_flat(pairs.draw_flat(), std::to_string(k), tally);
  report.head({"flat pairs", "number"});
  report.row("gradient defined", {double(tally.defined)});
  report.row("Jacobians, too", {double(tally.second)});
  report.row("refused", {double(tally.refused)});
  report.row("refused without need", {double(tally.needless)});
  report.row("others", {double(tally.unanswered)});
  report.row("evaluations, each", {tally.evaluations / static_cast<double>(tally.pairs)});
  for (int i = 0; i < tally.wrong; ++i) report.fault("gradient");
  std::printf("%s", tally.wrong_pairs.c_str());
}

/// A slow search checks every impact: none may be missed, late or early.
void run_impacts(const Draws& draws, Report& report) {
  report.head({"motion", "pairs", "hits", "apart", "not converged", "evaluations", "most"});
  for (const MotionKind& kind : kMotionKinds) {
    RandomMotions random(static_cast<unsigned>(draws.seed));
    double hits = 0, apart = 0, not_converged = 0, evaluations = 0;
    int most = 0;
    for (std::uint64_t k = 0; k < draws.count; ++k) {
      const MovingPair pair = random.draw(kind, std::pow(10, random.uniform(-6, 0.3)));
      const Impact impact = find_impact(pair);
      evaluations += impact.evaluations;
      most = std::max(most, impact.evaluations);
      ++(impact.status == ImpactStatus::Hits ? hits : impact.status == ImpactStatus::Apart ? apart : not_converged);
      const Verdict verdict = judge(pair, impact);
      if (verdict.is_right()) continue;
      std::ostringstream what;
      what << kind.name << ", pair " << k << ": overlap before " << verdict.overlap_before << " m, gap then " << verdict.gap
           << " m, unit " << pair.unit << " m, earlier by " << verdict.earlier << " s, at " << impact.time << " of " << pair.horizon
           << " s";
      report.fault(what.str());
    }
    const auto pairs = static_cast<double>(draws.count);
    report.row(kind.name, {pairs, hits, apart, not_converged, evaluations / pairs, static_cast<double>(most)});
  }
}

}  // namespace supernormal::test
