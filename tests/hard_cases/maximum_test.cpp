// The search for a normal higher than an answer's interval finds one if there is one.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "invariants.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/hard_cases/builders.hpp"

using namespace supernormal;
using namespace supernormal::samples;

namespace {

/// The answer of an ascent that ends before the maximum, by an angle.
Proximity beside(const HardCase& one, Proximity answer, double angle) {
  answer.normal = (answer.normal + angle * answer.normal.unitOrthogonal()).normalized();
  GapFunction gap(*one.shape1, one.pose1, *one.shape2, one.pose2);
  GapJet jet;
  gap.evaluate(answer.normal, Order::Value, jet);
  answer.gap = jet.s;
  return answer;
}

}  // namespace

TEST_CASE("an answer beside the maximum is detected, for bodies apart, touching or in a certified overlap") {
  Settings settings;
  settings.certify_depth = true;
  for (const double distance : {2.5, 2.0, 1.5}) {
    const HardCase one = pair("", "", ellipsoid(Vector3(1, 0.7, 0.5)), superball(1, 4), at(Vector3(distance, 0.3, 0.2)));
    const Proximity answer = find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, settings);
    CHECK(answer.is_global);
    CHECK(check_maximum(one, settings, answer).empty());
    CHECK_FALSE(check_maximum(one, settings, beside(one, answer, 1e-3)).empty());
  }
}

TEST_CASE("an answer of an overlap whose interval excludes a higher normal is detected") {
  const HardCase one = pair("", "", ellipsoid(Vector3(1, 0.7, 0.5)), superball(1, 4), at(Vector3(1.0, 0.3, 0.2)));
  Proximity answer = find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, {});
  CHECK_FALSE(answer.is_global);
  CHECK(check_maximum(one, {}, answer).empty());
  answer = beside(one, answer, 0.1);
  answer.global_error = 1e-6;
  CHECK_FALSE(check_maximum(one, {}, answer).empty());
  answer.global_error = 1;
  CHECK(check_maximum(one, {}, answer).empty());
}
