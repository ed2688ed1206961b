// Derivatives of any number of random pairs beside differences in long double, or gradients of flat pairs beside differences.
#include <cstdio>
#include <cstring>
#include <iostream>

#include "proximity/derivatives/comparison.hpp"
#include "whole_number.hpp"

namespace supernormal::test {
namespace {

bool run(int pairs, DerivativePairs& draws) {
  Tally tally;
  for (int k = 0; k < pairs; ++k) compare(draws.draw(), std::to_string(k), tally);
  print(std::cout, tally);
  int wrong = tally.not_finite;
  for (const Tally::Figures& figures : tally.figures) wrong += figures.wrong;
  return wrong == 0;
}

bool run_flat(int pairs, DerivativePairs& draws) {
  FlatTally tally;
  for (int k = 0; k < pairs; ++k) compare_flat(draws.draw_flat(), std::to_string(k), tally);
  print(std::cout, tally);
  return tally.wrong == 0;
}

}  // namespace
}  // namespace supernormal::test

int main(int argc, char** argv) {
  using namespace supernormal::test;
  const bool is_flat = argc == 4 && std::strcmp(argv[3], "--flat") == 0;
  const bool is_usual = argc == 3;
  const int pairs = is_flat || is_usual ? whole_number(argv[1]) : -1;
  const int seed = is_flat || is_usual ? whole_number(argv[2]) : -1;
  if (pairs < 1 || seed < 0) {
    std::fprintf(stderr, "derivatives PAIRS SEED [--flat]: PAIRS is a number from 1, SEED one from 0\n");
    return 2;
  }
  DerivativePairs draws(static_cast<unsigned>(seed));
  return (is_flat ? run_flat(pairs, draws) : run(pairs, draws)) ? 0 : 1;
}
