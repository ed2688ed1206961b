// Derivatives of any number of random pairs beside differences in long double.
#include <cstdio>
#include <iostream>

#include "proximity/derivatives/comparison.hpp"
#include "whole_number.hpp"

int main(int argc, char** argv) {
  using namespace supernormal::test;
  const int pairs = argc == 3 ? whole_number(argv[1]) : -1;
  const int seed = argc == 3 ? whole_number(argv[2]) : -1;
  if (pairs < 1 || seed < 0) {
    std::fprintf(stderr, "derivatives PAIRS SEED: PAIRS is a number from 1, SEED one from 0\n");
    return 2;
  }
  DerivativePairs draws(static_cast<unsigned>(seed));
  Tally tally;
  for (int k = 0; k < pairs; ++k) compare(draws.draw(), std::to_string(k), tally);
  print(std::cout, tally);
  int wrong = tally.not_finite;
  for (const Tally::Figures& figures : tally.figures) wrong += figures.wrong;
  return wrong == 0 ? 0 : 1;
}
