// The catalogue in a program that traps floating-point exceptions: an exception ends the program.
#include "support/traps.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "supernormal/proximity/solve.hpp"
#include "support/hard_cases/catalogue.hpp"

using namespace supernormal;
using namespace supernormal::samples;
using supernormal::test::Traps;

namespace {

bool is_finite(const Proximity& answer) {
  double sum = answer.gap + answer.normal.sum();
  sum += answer.point1.sum() + answer.point2.sum() + answer.contact.sum();
  return std::isfinite(sum);
}

}  // namespace

TEST_CASE("hard cases: no query raises a floating-point exception") {
  const std::vector<HardCase> cases = hard_cases();
  for (const HardCase& one : cases) {
    for (const bool certify : {false, true}) {
      Settings settings;
      settings.certify_depth = certify;
      bool finite = false;
      {
        const Traps traps(one.name.c_str());
        const Vector3* start = one.first_normal ? &*one.first_normal : nullptr;
        finite = is_finite(find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, settings, start));
      }
      if (!finite) FAIL_CHECK(one.name);
    }
  }
}

TEST_CASE("hard cases: making or refusing a shape raises no floating-point exception") {
  {
    const Traps traps("the shapes of the catalogue");
    CHECK(!hard_cases().empty());
  }
  for (const Refusal& refusal : refusals()) {
    const Traps traps(refusal.name.c_str());
    CHECK_THROWS_AS(refusal.attempt(), std::invalid_argument);
  }
}
