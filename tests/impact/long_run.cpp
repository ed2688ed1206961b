// Any number of random pairs in motion. A slow search checks every impact.
//
//     impacts PAIRS SEED        PAIRS of each kind of motion
//
// Prints a line for each kind, and each pair that was missed. Exit code 0: none was missed, late or early; 1: some were.
#include <cstdio>
#include <exception>

#include "random_motions.hpp"
#include "whole_number.hpp"

namespace {

using namespace supernormal;
using namespace supernormal::test;

struct Tally {
  long hits = 0, apart = 0, not_converged = 0, evaluations = 0, wrong = 0;
  int most = 0;
};

void add(const MotionKind& kind, int index, const MovingPair& pair, Tally& tally) {
  const Impact impact = find_impact(pair);
  tally.evaluations += impact.evaluations;
  tally.most = std::max(tally.most, impact.evaluations);
  if (impact.status == ImpactStatus::Hits) ++tally.hits;
  if (impact.status == ImpactStatus::Apart) ++tally.apart;
  if (impact.status == ImpactStatus::NotConverged) ++tally.not_converged;
  const Verdict verdict = judge(pair, impact);
  if (verdict.is_right()) return;
  ++tally.wrong;
  std::printf("%s, pair %d: overlap before %g m, gap then %g m, unit %g m, earlier by %g s, at %g of %g s\n", kind.name, index,
              verdict.overlap_before, verdict.gap, pair.unit, verdict.earlier, impact.time, pair.horizon);
}

/// Returns how many pairs were wrong.
long run(int pairs, int seed) {
  std::printf("%-22s %8s %8s %8s %14s %12s %8s %6s\n", "motion", "pairs", "hits", "apart", "not converged", "evaluations", "most",
              "wrong");
  long wrong = 0;
  for (const MotionKind& kind : kMotionKinds) {
    RandomMotions random(static_cast<unsigned>(seed));
    Tally tally;
    for (int k = 0; k < pairs; ++k) add(kind, k, random.draw(kind, std::pow(10, random.uniform(-6, 0.3))), tally);
    std::printf("%-22s %8d %8ld %8ld %14ld %12.2f %8d %6ld\n", kind.name, pairs, tally.hits, tally.apart, tally.not_converged,
                static_cast<double>(tally.evaluations) / pairs, tally.most, tally.wrong);
    wrong += tally.wrong;
  }
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  const int pairs = argc == 3 ? whole_number(argv[1]) : -1;
  const int seed = argc == 3 ? whole_number(argv[2]) : -1;
  if (pairs < 1 || seed < 0) {
    std::fprintf(stderr, "impacts PAIRS SEED: PAIRS is a number from 1, SEED one from 0\n");
    return 2;
  }
  try {
    return run(pairs, seed) == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "impacts: %s\n", error.what());
    return 2;
  }
}
