// Any number of flights past bodies and surfaces at a thousandth of the size. None may lose velocity.
//
//     fly_bys FLIGHTS SEED        FLIGHTS past each kind of obstacle
//
// Prints a line for each kind, and each flight that loses more than 1e-9 of its velocity. Exit code 0: none does; 1: some do.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>

#include "ode/colliders/fly_bys.hpp"
#include "support/ode_fixture.hpp"
#include "whole_number.hpp"

namespace {

using namespace supernormal::test;

/// Returns how many flights lost velocity.
int run(Passed passed, int flights, unsigned seed) {
  int held_back = 0;
  double most = 0;
  for (int k = 0; k < flights; ++k) {
    const unsigned of_flight = seed + static_cast<unsigned>(k);
    const double lost = fly_by(of_flight, passed, 1e-3);
    most = std::max(most, lost);
    if (lost < within_rounding(1e-9, 10)) continue;
    ++held_back;
    std::printf("%s, seed %u: loses %g of its velocity\n", name_of(passed), of_flight, lost);
  }
  std::printf("%-12s %6d flights, %3d held back, most %.1e\n", name_of(passed), flights, held_back, most);
  return held_back;
}

}  // namespace

int main(int argc, char** argv) {
  const int flights = argc == 3 ? whole_number(argv[1]) : -1;
  const int seed = argc == 3 ? whole_number(argv[2]) : -1;
  if (flights < 1 || seed < 0) {
    std::fprintf(stderr, "fly_bys FLIGHTS SEED: FLIGHTS is a number from 1, SEED one from 0\n");
    return 2;
  }
  // The flights belong to a test case, whose requirements end the program here.
  doctest::Context context;
  context.setAsDefaultForAssertsOutOfTestCases();
  const OdeSession session;
  int held_back = 0;
  for (const Passed passed : kAllPassed) held_back += run(passed, flights, static_cast<unsigned>(seed));
  return held_back == 0 ? 0 : 1;
}
