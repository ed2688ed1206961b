// Tests that a pair's answer is the same alone, among others and in any width, and that the powers are accurate.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "proximity/among_many.hpp"
#include "shapes/lanes/powers.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/draw.hpp"
#include "support/painted_stack.hpp"
#include "support/random_queries.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// Pairs of all kinds at gaps from far apart to concentric, and queries of them from no normal, a good one and a poor one.
class ManyPairs : public RandomQueries {
 public:
  explicit ManyPairs(bool all_shapes) {
    for (const RandomKind& kind : random_kinds()) {
      if (!all_shapes && kind.partner != RandomPartner::Superellipsoid) continue;
      RandomBodies& bodies = bodies_of(kind, 11);
      for (int round = 0; round < draws(6); ++round) {
        for (const double gap : {1e3, 0.3, 1e-2, 1e-9, 0.0, -1e-9, -1e-3, -0.02, -0.3}) add(bodies.draw(gap));
      }
      RandomPair concentric = bodies.draw(0);
      concentric.pose2.position.setZero();
      add(concentric);
    }
    for (std::size_t k = 0; k < pair_count(); ++k) {
      for (const Vector3* first : {static_cast<const Vector3*>(nullptr), normal(k), normal((k + 1) % pair_count())}) ask(k, first);
    }
    shuffle(3);
  }
};

std::vector<Settings> all_settings() {
  std::vector<Settings> all(6);
  all[1].stop_when_apart = true;
  all[2].tolerance = 1e-14;
  all[3].max_evaluations = 3;
  all[4].certify_depth = true;
  all[5].tolerance = 1e-3;
  return all;
}

int count_different(const std::vector<ProximityQuery>& queries, const Settings& settings, const std::vector<Proximity>& answers) {
  int different = 0;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    different += are_identical(numbers_of(answers[k]), numbers_of(find_proximity(queries[k], settings))) ? 0 : 1;
  }
  return different;
}

}  // namespace

TEST_CASE("powers have an error of a few units of rounding, and of the exponent times more") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst_power = 0, worst_root = 0;
  for (int k = 0; k < 200000; ++k) {
    const double x = std::exp2(-std::exp2(12 * uniform(engine) - 4)), p = std::exp2(17 * uniform(engine) - 10);
    const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(p));
    if (!(x >= 1e-300) || exact < 0x1p-899L) continue;
    const double found = power(supernormal::Real<1>(x), supernormal::Real<1>(p)).v;
    worst_power = std::max(worst_power, static_cast<double>(std::abs(found / exact - 1) * 0x1p53L) / (3 + p));
    const double sum = 1 + uniform(engine) * 2, inverse = uniform(engine);
    const long double exact_root = std::pow(static_cast<long double>(sum), static_cast<long double>(inverse));
    worst_root = std::max(
        worst_root,
        static_cast<double>(std::abs(root(supernormal::Real<1>(sum), supernormal::Real<1>(inverse)).v / exact_root - 1) * 0x1p53L));
  }
  MESSAGE("power: ", worst_power, " times 3 + p units, root: ", worst_root, " units of 2^-53");
  CHECK(worst_power <= 1);
  CHECK(worst_root <= 4);
}

TEST_CASE("lanes give the digits of one pair alone, in every width, order and company") {
  const ManyPairs many(false);
  const std::vector<ProximityQuery>& queries = many.queries();
  for (const Settings& settings : all_settings()) {
    const LaneKernels& kernels = lane_kernels();
    for (int k = 0; k < kernels.count; ++k) {
      const LaneKernel& kernel = *kernels.kernels[k];
      CAPTURE(kernel.name);
      std::vector<Proximity> answers(queries.size());
      const Traps traps("lanes");
      // Ranges of every length up to 70: no number of pairs fills the lanes better than others do.
      for (std::size_t first = 0, size = 1; first < queries.size(); first += size, size = size % 70 + 1) {
        const std::size_t count = std::min(size, queries.size() - first);
        find_in_lanes({queries.data() + first, count}, settings, kernel, {answers.data() + first, count});
      }
      CHECK(count_different(queries, settings, answers) == 0);
    }
  }
}

TEST_CASE("many pairs of any shapes at once give the digits of find_proximity") {
  const ManyPairs many(true);
  for (const Settings& settings : all_settings()) {
    std::vector<Proximity> answers(many.queries().size());
    find_proximities(many.queries(), settings, answers);
    CHECK(count_different(many.queries(), settings, answers) == 0);
  }
}

TEST_CASE("many pairs at once: what is not usable has no answer, and does not disturb its neighbours") {
  const ManyPairs many(true);
  std::vector<ProximityQuery> queries(many.queries().begin(), many.queries().begin() + 50);
  Pose nowhere, sheared;
  nowhere.position.x() = std::nan("");
  sheared.rotation(0, 1) = 0.5;
  const Vector3 no_unit(0, 0, 3);
  queries[3].pose2 = &nowhere;
  queries[20].pose1 = &sheared;
  queries[21].first_normal = &no_unit;  // is ignored
  std::vector<Proximity> answers(queries.size());
  find_proximities(queries, {}, answers);
  CHECK(answers[3].status == Status::InvalidInput);
  CHECK(answers[20].status == Status::InvalidInput);
  CHECK(answers[21].status == Status::Converged);
  CHECK(count_different(queries, {}, answers) == 0);
  std::vector<Proximity> too_few(49);
  CHECK_THROWS_WITH_AS(find_proximities(queries, {}, too_few), "results has 49 elements, and there are 50 queries",
                       std::invalid_argument);
  CHECK_THROWS_AS(find_proximities(queries, {.tolerance = 0}, answers), std::invalid_argument);
}

TEST_CASE("lanes read no number that was not set") {
  const ManyPairs many(false);
  const LaneKernels& kernels = lane_kernels();
  for (std::size_t first = 0; first + 5 < 200; first += 5) {
    for (int k = 0; k < kernels.count; ++k) {
      CHECK(is_same_on_every_stack([&] {
        std::array<Proximity, 5> answers;
        find_in_lanes({many.queries().data() + first, 5}, {}, *kernels.kernels[k], answers);
        return answers[2];
      }));
    }
  }
}

TEST_CASE("lanes: sizes and distances at the ends of the range raise no exception") {
  const Superellipsoid huge(Vector3::Constant(1e30), 2, 1.1), tiny(Vector3::Constant(1e-30), 1.1, 2);
  RandomBodies random(random_kinds().front(), 5);
  const Traps traps("ends of the range");
  for (int k = 0; k < 200; ++k) {
    const Pose here{Vector3::Zero(), random.draw_apart().pose2.rotation};
    const Vector3 direction = random.draw_apart().pose2.rotation.col(0);
    const Pose there{(k % 2 == 0 ? 5e149 : 1e30) * direction, random.draw_apart().pose2.rotation};
    for (const auto& [one, other] : {std::pair(&huge, &tiny), std::pair(&tiny, &huge), std::pair(&tiny, &tiny)}) {
      CHECK(std::isfinite(find_proximity(*one, here, *other, there).gap));
      const Vector3 normal = Vector3::UnitY();
      CHECK(std::isfinite(find_proximity(*one, here, *other, there, {}, &normal).gap));
    }
  }
}
