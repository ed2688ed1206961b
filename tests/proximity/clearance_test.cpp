// Whether bodies are farther apart than a distance, beside the gap of the query.
#include "supernormal/proximity/clearance.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "support/draw.hpp"
#include "support/random_bodies.hpp"
#include "support/refusal.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

struct Count {
  int pairs = 0, evaluations = 0, wrong = 0;
};

bool ask(const RandomPair& pair, double distance, Vector3* normal, int& evaluations) {
  return is_farther_than(*pair.shape1, {}, *pair.shape2, pair.pose2, distance, normal, &evaluations);
}

}  // namespace

// Bodies nearer to one another than half of the smaller half-extent need a better normal than the first guess, and more
// evaluations.
TEST_CASE("is_farther_than: right for all kinds, and 1.2 evaluations at most where the bodies are twice as far apart") {
  Count twice, warm, all;
  for (const RandomKind& kind : random_kinds()) {
    RandomBodies bodies(kind, 71);
    for (int k = 0; k < draws(400); ++k) {
      const bool is_near = k % 4 == 0;
      const RandomPair pair = bodies.draw(is_near ? bodies.uniform(0.02, 0.5) : bodies.uniform(0.5, 8));
      const Proximity answer = find_proximity(*pair.shape1, {}, *pair.shape2, pair.pose2);
      if (answer.status != Status::Converged) continue;
      for (const double fraction : {0.2, 0.5, 0.99, 1.0 + 1e-6, 1.5, 4.0}) {
        int evaluations = 0;
        Vector3 normal = Vector3::Zero();
        const bool is_farther = ask(pair, fraction * answer.gap, &normal, evaluations);
        ++all.pairs;
        all.evaluations += evaluations;
        all.wrong += is_farther != (fraction < 1);
        // The normal gives the bound.
        const double bound = normal.dot(pair.pose2.position) - pair.shape1->support(normal) -
                             pair.shape2->support(-(pair.pose2.rotation.transpose() * normal));
        if (is_farther) CHECK(bound >= fraction * answer.gap * (1 - 1e-12));
        if (fraction != 0.5 || is_near) continue;
        ++twice.pairs;
        twice.evaluations += evaluations;
        CHECK(ask(pair, fraction * answer.gap, &normal, evaluations));
        ++warm.pairs;
        warm.evaluations += evaluations;
      }
    }
  }
  MESSAGE("evaluations: ", twice.evaluations / static_cast<double>(twice.pairs), " twice as far, ",
          warm.evaluations / static_cast<double>(warm.pairs), " with the last normal, ",
          all.evaluations / static_cast<double>(all.pairs), " of all");
  CHECK(all.wrong == 0);
  CHECK(twice.evaluations <= 1.2 * twice.pairs);
  CHECK(warm.evaluations <= warm.pairs);
}

// The numbers are dyadic, so that the gap is exact: the direction (2, 3, 6) has the length 7.
TEST_CASE("is_farther_than: bodies are not farther apart than their gap, in spite of rounding") {
  std::mt19937_64 engine(75);
  const auto dyadic = [&engine](int most) { return std::ldexp(static_cast<double>(1 + engine() % (1U << 20)), -20) * most; };
  for (int k = 0; k < 2000; ++k) {
    const double radius1 = dyadic(1), radius2 = dyadic(1), unit = 1 + dyadic(4);
    const double gap = 7 * unit - radius1 - radius2;
    const Pose pose2{unit * Vector3(2, -3, 6), Eigen::Quaterniond(0.5, 0.1, -0.7, 0.2).normalized().toRotationMatrix()};
    CHECK_FALSE(is_farther_than(Ellipsoid(Vector3::Constant(radius1)), {}, Ellipsoid(Vector3::Constant(radius2)), pose2, gap));
    CHECK(is_farther_than(Ellipsoid(Vector3::Constant(radius1)), {}, Ellipsoid(Vector3::Constant(radius2)), pose2,
                          gap - 1e-13 * unit));
  }
}

// A point of both bodies decides. Polytopes and bodies of callbacks know none.
TEST_CASE("is_farther_than: overlapping bodies are not farther than 0; round ones take 1.3 evaluations") {
  for (const RandomKind& kind : random_kinds()) {
    RandomBodies bodies(kind, 74);
    Count all;
    for (int k = 0; k < draws(200); ++k) {
      const RandomPair pair = bodies.draw(-bodies.uniform(0.001, 0.5));
      if (!(find_proximity(*pair.shape1, {}, *pair.shape2, pair.pose2).gap < -1e-6)) continue;
      int evaluations = 0;
      ++all.pairs;
      all.wrong += ask(pair, 0.01, nullptr, evaluations) || ask(pair, 0, nullptr, evaluations);
      all.evaluations += evaluations;
    }
    CHECK(all.wrong == 0);
    const bool is_round = kind.name == "ellipsoid" || kind.name == "moderate" || kind.name == "any and capsule";
    if (is_round) CHECK(all.evaluations <= 1.3 * all.pairs);
  }
}

TEST_CASE("find_clearance: a lower bound of the gap, better with more evaluations") {
  std::array<int, 3> better{};
  for (const RandomKind& kind : random_kinds()) {
    RandomBodies bodies(kind, 72);
    for (int k = 0; k < draws(200); ++k) {
      const RandomPair pair = bodies.draw(bodies.uniform(-0.3, 2));
      const Proximity answer = find_proximity(*pair.shape1, {}, *pair.shape2, pair.pose2, {.certify_depth = true});
      double last = -std::numeric_limits<double>::infinity();
      for (const int budget : {1, 2, 3}) {
        const Clearance bound = find_clearance(*pair.shape1, {}, *pair.shape2, pair.pose2, 1e300, budget);
        CHECK(bound.evaluations <= budget);
        CHECK(bound.lower_bound <= answer.gap + answer.global_error);
        CHECK(bound.lower_bound >= last);
        better.at(static_cast<std::size_t>(budget) - 1) += bound.lower_bound > last;
        CHECK(std::abs(bound.normal.norm() - 1) < 1e-14);
        GapJet there;
        GapFunction(*pair.shape1, {}, *pair.shape2, pair.pose2).evaluate(bound.normal, Order::Value, there);
        CHECK(there.s >= bound.lower_bound);
        last = bound.lower_bound;
      }
    }
  }
  MESSAGE("better: ", better[1], " with two evaluations, ", better[2], " with three, of ", better[0]);
  CHECK(better[1] > 0.5 * better[0]);
  CHECK(better[2] > 0.5 * better[0]);
}

TEST_CASE("are_farther_than: many pairs have the answers of each") {
  const RandomKind kind = random_kinds().front();
  RandomBodies bodies(kind, 73);
  std::vector<RandomPair> pairs;
  pairs.reserve(100);
  for (int k = 0; k < 100; ++k) pairs.push_back(bodies.draw(bodies.uniform(0, 2)));
  const Pose origin;
  std::vector<ProximityQuery> queries;
  queries.reserve(pairs.size());
  for (const RandomPair& pair : pairs) queries.push_back({pair.shape1.get(), &origin, pair.shape2.get(), &pair.pose2});
  std::vector<Clearance> results(pairs.size());
  const auto flags = std::make_unique<bool[]>(pairs.size());
  const std::size_t count = are_farther_than(queries, 0.5, results, {flags.get(), pairs.size()});
  std::size_t expected = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    int evaluations = 0;
    const bool is_farther = ask(pairs[k], 0.5, nullptr, evaluations);
    CHECK(is_farther == flags[k]);
    CHECK(evaluations == results[k].evaluations);
    expected += is_farther;
  }
  CHECK(count == expected);
  CHECK_THROWS_AS(are_farther_than(queries, 0.5, results, {flags.get(), 3}), std::invalid_argument);
}

TEST_CASE("clearance: bad input is refused, or gives no bound") {
  const Ellipsoid body(Vector3(1, 2, 3));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(is_farther_than(body, {}, body, {{9, 0, 0}, Matrix3::Identity()}, nan), std::invalid_argument);
  CHECK_THROWS_AS(find_clearance(body, {}, body, {}, 1, 0), std::invalid_argument);
  CHECK_THROWS_AS(find_clearance(body, {}, body, {}, 1, 4), std::invalid_argument);
  CHECK_THROWS_AS(find_clearance(body, {}, body, {}, nan), std::invalid_argument);
  Pose broken;
  broken.position.x() = nan;
  CHECK_FALSE(is_farther_than(body, broken, body, {}, -100));
  CHECK(find_clearance(body, broken, body, {}).lower_bound == -std::numeric_limits<double>::infinity());
}
