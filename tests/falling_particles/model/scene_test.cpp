// Settings of queries, and the memory that a scene needs.
#include "model/scene.hpp"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "observe/simulation.hpp"
#include "scenes.hpp"

using namespace falling_particles;

namespace {

/// The counts of queries and the places of the grains after some steps of a small heap of ellipsoids.
struct Outcome {
  snStatistics counts;
  std::vector<Point> places;
};

Outcome outcome(const std::optional<Query>& query) {
  Scene scene = scene_of(Box{{0.02, 0.02}}, {{lentil(), 30}});
  scene.query = query;
  Simulation simulation(scene, 1);
  for (int step = 0; step < 400; ++step) simulation.stepper.step(false);
  Outcome result{simulation.statistics(), {}};
  for (const Grain& grain : simulation.world.grains()) result.places.push_back(grain.position());
  return result;
}

double evaluations(const Outcome& outcome) {
  const snStatistics& n = outcome.counts;
  return static_cast<double>(n.evaluations_cold + n.evaluations_warm) / static_cast<double>(n.queries_cold + n.queries_warm);
}

}  // namespace

TEST_CASE("query: a section with the library's defaults changes no digit") {
  const Outcome without = outcome({}), with = outcome(Query{});
  CHECK(without.counts.queries_warm > 1000);
  CHECK(with.places == without.places);
  CHECK(with.counts.evaluations_warm == without.counts.evaluations_warm);
}

TEST_CASE("query: the settings reach the library, and the next world has the defaults again") {
  const Outcome before = outcome({});
  const Outcome cold = outcome(Query{.warm_start = false});
  CHECK(cold.counts.queries_warm == 0);
  CHECK(cold.counts.queries_cold > 1000);
  const Outcome fixed_point = outcome(Query{.solver = SN_SOLVER_FIXED_POINT});
  CHECK(evaluations(fixed_point) > evaluations(before));
  const Outcome loose = outcome(Query{.tolerance = 0.1});
  CHECK(evaluations(loose) < evaluations(before));
  const Outcome short_of = outcome(Query{.solver = SN_SOLVER_FIXED_POINT, .max_evaluations = 2});
  CHECK(short_of.counts.not_converged > 0);
  CHECK(short_of.counts.out_of_evaluations == short_of.counts.not_converged);
  CHECK(short_of.counts.contacts_not_converged > 0);
  CHECK(short_of.counts.contacts_not_converged <= short_of.counts.contacts);
  CHECK(outcome({}).places == before.places);
}

TEST_CASE("query: the section is read, and mistakes are refused") {
  CHECK_FALSE(scene_of(kSceneText).query.has_value());
  const Scene scene =
      scene_of(kSceneText, {"query={solver = \"newton\", tolerance = 1e-6, max_evaluations = 50, warm_start = false}"});
  REQUIRE(scene.query.has_value());
  CHECK(scene.query->solver == SN_SOLVER_NEWTON);
  CHECK(scene.query->tolerance == 1e-6);
  CHECK(scene.query->max_evaluations == 50);
  CHECK_FALSE(scene.query->warm_start);
  const auto refused = [](const char* key) { return complaint(kSceneText, kCatalogueText, {std::string("query={") + key + "}"}); };
  check_says(refused("solver = \"bisection\""), {"query.solver", "bisection", "hybrid", "newton", "fixed_point"});
  check_says(refused("tolerance = 2"), {"query.tolerance", "2", "[1e-15, 1]"});
  check_says(refused("max_evaluations = 0"), {"query.max_evaluations", "0", "1 to 1000000"});
  check_says(refused("warm = true"), {"warm", "solver", "warm_start"});
}

TEST_CASE("memory grows in proportion to the grains") {
  CHECK(memory_needed(2'000'000) < 2 * memory_needed(1'000'000));
  CHECK(memory_needed(1'000'000) < 25e9);
  for (const double bytes : {1e8, 1e9, 23e9}) {
    const int grains = most_grains(bytes);
    CHECK(memory_needed(grains) <= bytes);
    CHECK(memory_needed(grains + 1) > bytes);
  }
  CHECK(most_grains(0) == 0);
  CHECK(memory_of_machine() > 1e8);
}
