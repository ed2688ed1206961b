// Random pairs in motion. A slow search checks every impact: none may be missed, late or early.
#include <cmath>
#include <sstream>

#include "impact/random_motions.hpp"
#include "pairs/kinds.hpp"

void supernormal::test::run_impacts(const Draws& draws, Report& report) {
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
