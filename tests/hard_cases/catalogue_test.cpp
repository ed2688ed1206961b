// Every case of the catalogue: the hybrid's answers against the reference, and conditions that hold without a reference.
#include "support/hard_cases/catalogue.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "invariants.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/hard_cases/builders.hpp"

using namespace supernormal;
using namespace supernormal::samples;

namespace {

const std::vector<HardCase>& catalogue() {
  static const std::vector<HardCase> cases = hard_cases();
  return cases;
}

struct ReferencedCase {
  const HardCase* one;
  Reference reference;
};

const std::vector<ReferencedCase>& referenced_cases() {
  static const std::vector<ReferencedCase> cases = [] {
    std::vector<ReferencedCase> out;
    for (const HardCase& one : catalogue()) out.push_back({&one, find_reference(one)});
    return out;
  }();
  return cases;
}

std::string describe(const HardCase& one) {
  return one.name + " (" + one.reason + ")\n  " + describe(one.body1) + "\n  " + describe(one.body2) + "\n  ";
}

/// Reports one failure for each case, with the settings.
void report(const HardCase& one, const Settings& settings, const Violations& violations) {
  if (violations.empty()) return;
  std::string sentences;
  for (const std::string& sentence : violations) sentences += "\n  - " + sentence;
  FAIL_CHECK(describe(one), "tolerance ", settings.tolerance, ", at most ", settings.max_evaluations, " evaluations:", sentences);
}

Settings certified() { return {.max_evaluations = 20000, .certify_depth = true}; }

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

TEST_CASE("hard cases: a case that is apart, touching or overlapping by less than the rolling radius converges") {
  for (const HardCase& one : catalogue()) {
    Violations exceptions;
    const Proximity answer = solve(one, {}, exceptions);
    const GapFunction gap(*one.shape1, one.pose1, *one.shape2, one.pose2);
    if (answer.gap + gap.rolling_radius() >= 0 && answer.status != Status::Converged) {
      FAIL_CHECK(describe(one), "status ", static_cast<int>(answer.status), ", gap ", answer.gap, ", error ", answer.error);
    }
  }
}

TEST_CASE("hard cases: every case has a unique name and a reason") {
  std::set<std::string> names;
  for (const HardCase& one : catalogue()) {
    if (!names.insert(one.name).second) FAIL_CHECK("twice: ", one.name);
    if (one.reason.empty()) FAIL_CHECK("no reason: ", one.name);
  }
  CHECK(names.size() > 300);
}

TEST_CASE("hard cases: the gaps in closed form lie within the bounds by branch and bound") {
  for (const HardCase& one : catalogue()) {
    if (!one.gap) continue;
    const double distance = enclose_gap(one, 10000).distance(*one.gap);
    if (!(distance <= rounding_of(one))) FAIL_CHECK(describe(one), "gap ", *one.gap, " is off by ", distance);
  }
}

TEST_CASE("hard cases: no invariant is violated") {
  for (const HardCase& one : catalogue()) report(one, {}, check(one));
}

TEST_CASE("hard cases: no invariant is violated at the ends of the range of tolerances") {
  Settings tight, loose;
  tight.tolerance = 1e-15;
  loose.tolerance = 0.1;
  for (const HardCase& one : catalogue()) {
    report(one, tight, check(one, tight));
    report(one, loose, check(one, loose));
  }
}

TEST_CASE("hard cases: no invariant is violated when the limit of evaluations is reached") {
  Settings settings;
  for (const int limit : {1, 2, 3, 5, 9}) {
    settings.max_evaluations = limit;
    for (const HardCase& one : catalogue()) report(one, settings, check(one, settings));
  }
}

TEST_CASE("hard cases: the reference lies in the interval of every answer, and equals the gap of every global answer") {
  for (const ReferencedCase& referenced : referenced_cases()) {
    const HardCase& one = *referenced.one;
    Violations violations;
    const Proximity answer = solve(one, {}, violations);
    report(one, {}, violations);
    const double rounding = rounding_of(one);
    const double distance = referenced.reference.distance(answer.gap);
    const bool is_in_interval =
        answer.gap <= referenced.reference.upper + rounding && referenced.reference.lower <= ceiling_of(one, {}, answer) + rounding;
    const bool is_right =
        !answer.is_global || (answer.status == Status::Converged && distance <= error_of(one, {}, answer) + rounding);
    if (!(is_in_interval && is_right)) {
      FAIL_CHECK(describe(one), "gap ", answer.gap, " is off by ", distance, "; at most ", ceiling_of(one, {}, answer), " status ",
                 static_cast<int>(answer.status));
    }
  }
}

TEST_CASE("hard cases: a certified depth equals the reference") {
  // If every normal of a circle is a maximum, the number of directions to rule out has no bound.
  int unproved = 0;
  for (const ReferencedCase& referenced : referenced_cases()) {
    const HardCase& one = *referenced.one;
    Violations violations;
    const Proximity answer = solve(one, certified(), violations);
    for (const auto& some : {check_answer(one, certified(), answer), check_maximum(one, certified(), answer)}) {
      violations.insert(violations.end(), some.begin(), some.end());
    }
    report(one, certified(), violations);
    const double allowed = error_of(one, certified(), answer) + rounding_of(one);
    const double distance = referenced.reference.distance(answer.gap);
    const bool ran_out = !answer.is_global && answer.evaluations >= certified().max_evaluations;
    unproved += ran_out ? 1 : 0;
    if (!(answer.is_global || ran_out) || !(distance <= allowed)) {
      FAIL_CHECK(describe(one), "gap ", answer.gap, " is off by ", distance, "; allowed ", allowed, " global ", answer.is_global,
                 " evaluations ", answer.evaluations);
    }
  }
  CHECK(unproved <= 1);
}

TEST_CASE("an answer beside the maximum is detected, for bodies apart, touching or in a certified overlap") {
  const Settings settings{.certify_depth = true};
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
