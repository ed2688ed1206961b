// Derivatives of random pairs beside differences in long double, and gradients of flat pairs beside differences.
#include <string>

#include "pairs/kinds.hpp"
#include "proximity/derivatives/comparison.hpp"

namespace supernormal::test {

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

}  // namespace supernormal::test
