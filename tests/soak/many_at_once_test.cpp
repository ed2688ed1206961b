// Tests that the hard cases and samples of the soak have the same answer alone and among many.
#include <doctest/doctest.h>

#include <vector>

#include "proximity/among_many.hpp"
#include "sample.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/painted_stack.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::soak;
using namespace supernormal::test;

namespace {

constexpr std::uint64_t kSamplesAmongMany = 10000;
constexpr double kSampledTolerances[] = {1e-9, 1e-3, 1e-6, 1e-12, 1e-15};

/// Asks each case cold (or from its own normal), and from the normal of a rough answer.
void check_among_many(const std::vector<samples::HardCase>& cases, const Settings& settings) {
  std::vector<Vector3> normals(cases.size());
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const samples::HardCase& one = cases[k];
    const Proximity rough = find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, {.tolerance = 1e-2});
    normals[k] = one.pose1.rotation.transpose() * rough.normal;
  }
  std::vector<ProximityQuery> queries;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const samples::HardCase& one = cases[k];
    const Vector3* const firsts[] = {one.first_normal ? &*one.first_normal : nullptr, &normals[k]};
    for (const Vector3* first : firsts) {
      queries.push_back({one.shape1.get(), &one.pose1, one.shape2.get(), &one.pose2, first});
    }
  }
  std::vector<Proximity> alone(queries.size()), among(queries.size());
  for (std::size_t k = 0; k < queries.size(); ++k) alone[k] = find_proximity(queries[k], settings);
  for (const WayAmongMany& way : ways_among_many()) {
    {
      const Traps traps(way.name.c_str());
      way.ask(queries, settings, among);
    }
    for (std::size_t k = 0; k < queries.size(); ++k) {
      if (!are_identical(numbers_of(alone[k]), numbers_of(among[k]))) FAIL_CHECK(way.name, ", ", cases[k / 2].name);
    }
  }
}

}  // namespace

TEST_CASE("hard cases have the same digits alone and among many") {
  for (const bool certify : {false, true}) {
    for (const bool is_early : {false, true}) {
      check_among_many(samples::hard_cases(), {.max_evaluations = 300, .stop_when_apart = is_early, .certify_depth = certify});
    }
  }
}

TEST_CASE("samples of the soak have the same digits alone and among many") {
  for (const Mix mix : {Mix::Everything, Mix::Sharp}) {
    const SampleSource source(23, mix);
    Sample sample;
    for (const double tolerance : kSampledTolerances) {
      std::vector<samples::HardCase> cases;
      for (std::uint64_t index = 0; index < kSamplesAmongMany; ++index) {
        source.draw(index, sample);
        if (sample.settings.tolerance == tolerance) cases.push_back(sample.pair);
      }
      REQUIRE(cases.size() > kSamplesAmongMany / 20);
      check_among_many(cases, {.tolerance = tolerance});
    }
  }
}
