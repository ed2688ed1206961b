// Tests that the former content of the stack changes no answer, for every hard case and samples of the soak.
#include <doctest/doctest.h>

#include "sample.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/draw.hpp"
#include "support/painted_stack.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::soak;
using namespace supernormal::test;

namespace {

const std::uint64_t kStackSamples = draws(4000);

void check_stack(const samples::HardCase& one, const Settings& settings) {
  const Vector3* const start = one.first_normal ? &*one.first_normal : nullptr;
  const auto ask = [&] { return find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, settings, start); };
  if (!is_same_on_every_stack(ask)) FAIL_CHECK(one.name);
  const Traps traps(one.name.c_str());
  ask_on_painted_stack(kSignallingNan, ask);
}

}  // namespace

TEST_CASE("hard cases give the same digits over any stack, and compute nothing with uninitialized memory") {
  Settings certified;
  certified.certify_depth = true;
  certified.max_evaluations = 300;
  for (const samples::HardCase& one : samples::hard_cases()) {
    check_stack(one, {});
    check_stack(one, certified);
  }
}

TEST_CASE("random pairs give the same digits over any stack, and compute nothing with uninitialized memory") {
  for (const Mix mix : {Mix::Everything, Mix::Sharp}) {
    const SampleSource source(22, mix);
    Sample sample;
    for (std::uint64_t index = 0; index < kStackSamples; ++index) {
      source.draw(index, sample);
      check_stack(sample.pair, sample.settings);
    }
  }
}
