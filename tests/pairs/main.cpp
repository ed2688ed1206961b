// Any number of the pairs of which the tests ask some.
//
//     pairs KIND PAIRS SEED [FIRST]
//
// Without arguments it prints the kinds. Exit code 0: every fact holds for every pair; 1: there are faults, and each is printed; 2:
// a mistake in the command.
#include <cstdio>
#include <cstring>
#include <exception>

#include "pairs/kinds.hpp"
#include "whole_number.hpp"

namespace {

using namespace supernormal::test;

struct Kind {
  const char* name;
  void (*run)(const Draws& draws, Report& report);
  const char* help;
  bool takes_first = false;
};

constexpr Kind kKinds[] = {
    {"lanes", run_lanes, "samples of the soak: the digits alone and among many"},
    {"derivatives", run_derivatives, "of all classes: derivatives beside differences in long double"},
    {"flat_derivatives", run_flat_derivatives, "with faces on one another: gradients beside differences"},
    {"clearances", run_clearances, "of all classes: whether they are farther apart than a distance"},
    {"impacts", run_impacts, "of each kind of motion: the time of impact beside a slow search"},
#ifdef SUPERNORMAL_PAIRS_IN_ODE
    {"fly_bys", run_fly_bys, "a body that passes each kind of obstacle at a thousandth of its size: its velocity"},
#endif
    {"soak", run_soak,
     "hard cases with changes and random pairs: the facts of every answer; one pair alone is printed in "
     "full",
     true},
    {"sharp_soak", run_sharp_soak, "the same of bodies with any exponents, and more directions around every answer", true},
};

int usage() {
  std::fprintf(stderr,
               "pairs KIND PAIRS SEED [FIRST]: PAIRS is a number from 1, SEED and FIRST (of the soaks) one from 0. Kinds:\n");
  for (const Kind& kind : kKinds) std::fprintf(stderr, "  %-18s%s\n", kind.name, kind.help);
  return 2;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4 || argc > 5) return usage();
  const int count = whole_number(argv[2]), seed = whole_number(argv[3]), first = argc == 5 ? whole_number(argv[4]) : 0;
  if (count < 1 || seed < 0 || first < 0) return usage();
  for (const Kind& kind : kKinds) {
    if (std::strcmp(kind.name, argv[1]) != 0 || (argc == 5 && !kind.takes_first)) continue;
    Report report;
    kind.run({static_cast<std::uint64_t>(count), static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(first)}, report);
    std::printf("%s %s %s: %ld faults\n", argv[1], argv[2], argv[3], report.faults());
    return report.faults() == 0 ? 0 : 1;
  }
  return usage();
} catch (const std::exception& error) {
  std::fprintf(stderr, "pairs: %s\n", error.what());
  return 2;
}
