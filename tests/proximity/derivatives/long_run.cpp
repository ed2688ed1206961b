// Derivatives of any number of random pairs beside differences in long double: derivatives [pairs] [seed]
#include <cstdlib>
#include <iostream>

#include "proximity/derivatives/comparison.hpp"

int main(int argc, char** argv) {
  using namespace supernormal::test;
  const int pairs = argc > 1 ? std::atoi(argv[1]) : 20000;
  DerivativePairs draws(argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1);
  Tally tally;
  for (int k = 0; k < pairs; ++k) compare(draws.draw(), std::to_string(k), tally);
  print(std::cout, tally);
  int wrong = tally.not_finite;
  for (const Tally::Figures& figures : tally.figures) wrong += figures.wrong;
  return wrong == 0 ? 0 : 1;
}
