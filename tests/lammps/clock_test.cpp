// Tests of the clock of a run with a changing step.
#include "kernel/clock.hpp"

#include <doctest/doctest.h>

using granular::Clock;

namespace {

void advance(Clock& clock, int steps, double step) {
  for (int i = 0; i < steps; ++i) clock.advance(step);
}

}  // namespace

TEST_CASE("lammps clock: the time is a product while the step is constant, and a sum of products when it changes") {
  Clock clock;
  CHECK(clock.now() == 0);
  advance(clock, 8000, 1e-5);
  CHECK(clock.now() == 8000 * 1e-5);
  advance(clock, 4000, 5e-6);
  CHECK(clock.now() == 8000 * 1e-5 + 4000 * 5e-6);
  advance(clock, 1, 1e-5);
  CHECK(clock.now() == doctest::Approx(0.10001).epsilon(1e-14));
}

TEST_CASE("lammps clock: a clock resumed from saved data has the same time to the bit") {
  Clock whole;
  advance(whole, 1000, 0.1);
  advance(whole, 333, 0.07);
  Clock again(whole.state());
  CHECK(again.now() == whole.now());
  advance(whole, 100, 0.07);
  advance(again, 100, 0.07);
  CHECK(again.now() == whole.now());
}
