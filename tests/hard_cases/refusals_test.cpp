// Tests that unusable parameters and poses are refused by a clear message, or by a status.
#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "invariants.hpp"
#include "support/hard_cases/catalogue.hpp"
#include "support/refusal.hpp"

using namespace supernormal;
using namespace supernormal::samples;

TEST_CASE("hard cases: invalid parameters are refused with a message") {
  for (const Refusal& refusal : refusals()) {
    const std::string message = test::refusal(refusal.attempt);
    // A name, a value and a range do not fit into fewer characters.
    if (message.size() < 20) FAIL_CHECK(refusal.name, " (", refusal.reason, "): \"", message, "\"");
  }
}

TEST_CASE("hard cases: poses that are not finite return InvalidInput") {
  for (const Solver solver : {Solver::Hybrid, Solver::Newton, Solver::FixedPoint}) {
    Settings settings;
    settings.solver = solver;
    for (const HardCase& one : cases_without_answer()) {
      Violations exceptions;
      for (const HardCase& either : {one, swapped(one)}) {
        const Proximity answer = solve(either, settings, exceptions);
        if (answer.status != Status::InvalidInput) FAIL_CHECK(one.name, " status ", static_cast<int>(answer.status));
      }
      for (const std::string& exception : exceptions) FAIL_CHECK(one.name, ": ", exception);
    }
  }
}
