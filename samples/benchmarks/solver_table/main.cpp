// The three solvers on pairs with known results, as a Markdown table: how often each fails, and its cost if it succeeds.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "support/reference_pairs.hpp"

namespace {

using namespace supernormal;
using test::ReferencePair;

// A gap is wrong if its error exceeds this fraction of the smallest half-axis.
constexpr double kWrong = 1e-6;
constexpr int kMaxEvaluations = 200;

// A pair with an overlap of more than this fraction of the smallest half-axis counts as overlapping, any other as touching. The
// groups in the file are 1e-3 and 2e-2.
constexpr double kTouching = 5e-3;

struct Tally {
  int failures = 0, pairs = 0;

  std::string text() const { return std::to_string(failures) + " of " + std::to_string(pairs); }
};

struct Row {
  Tally apart, overlapping;
  std::vector<int> evaluations;  // one number per success

  /// The number of evaluations at the fraction `share` of the successes.
  std::string percentile(double share) {
    if (evaluations.empty()) return "-";
    std::sort(evaluations.begin(), evaluations.end());
    const double rank = std::ceil(share * static_cast<double>(evaluations.size()));
    return std::to_string(evaluations[static_cast<std::size_t>(std::max(rank - 1, 0.0))]);
  }
};

Row measure(const std::vector<ReferencePair>& pairs, const std::string& kind, Solver solver) {
  Settings settings;
  settings.solver = solver;
  settings.max_evaluations = kMaxEvaluations;
  Row row;
  for (const ReferencePair& pair : pairs) {
    if (pair.kind != kind) continue;
    const Proximity out = test::solve(pair, settings);
    const bool good = out.status == Status::Converged && std::abs(out.gap - pair.gap) <= kWrong * pair.unit;
    Tally& tally = pair.gap < -kTouching * pair.unit ? row.overlapping : row.apart;
    ++tally.pairs;
    if (good) {
      row.evaluations.push_back(out.evaluations);
    } else {
      ++tally.failures;
    }
  }
  return row;
}

void print_table(const std::vector<ReferencePair>& pairs) {
  struct Named {
    Solver solver;
    const char* name;
  };
  constexpr Named kSolvers[] = {
      {Solver::Hybrid, "hybrid"}, {Solver::Newton, "Newton (Algorithm I)"}, {Solver::FixedPoint, "fixed point (Algorithm II)"}};
  std::printf("| class | solver | failures apart or touching | failures overlapped | median evaluations | 99th percentile |\n");
  std::printf("|---|---|---|---|---|---|\n");
  std::vector<std::string> kinds;
  for (const ReferencePair& pair : pairs) {
    if (std::find(kinds.begin(), kinds.end(), pair.kind) == kinds.end()) kinds.push_back(pair.kind);
  }
  for (const std::string& kind : kinds) {
    for (const Named& named : kSolvers) {
      Row row = measure(pairs, kind, named.solver);
      std::printf("| %s | %s | %s | %s | %s | %s |\n", kind.c_str(), named.name, row.apart.text().c_str(),
                  row.overlapping.text().c_str(), row.percentile(0.5).c_str(), row.percentile(0.99).c_str());
    }
  }
}

}  // namespace

int main(int argc, char** /*argv*/) {
  if (argc > 1) {
    std::puts(
        "usage: solver_table\nSolves the 1600 reference pairs of tests/data with three solvers; failures and evaluations as a "
        "table.");
    return 2;
  }
  try {
    print_table(test::reference_pairs());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "solver_table: %s\n", error.what());
    return 2;
  }
}
