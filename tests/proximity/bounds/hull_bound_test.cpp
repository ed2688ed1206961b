// The two lemmas on which every bound of the solver rests.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "proximity/bounds/minimum_norm_point.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/random_bodies.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr int kPairs = 40, kCuts = 12, kDirections = 60;

/// The differences d(n) + rho n of some normals, which are points of the difference of the bodies without the ball that rolls
/// inside.
std::vector<Vector3> cuts_of(GapFunction& gap, const std::vector<Vector3>& normals) {
  std::vector<Vector3> cuts;
  GapJet jet;
  for (const Vector3& n : normals) {
    gap.evaluate(n, Order::Point, jet);
    cuts.emplace_back(jet.d + gap.rolling_radius() * n);
    // At its own normal a cut is exact.
    CHECK(std::abs(n.dot(cuts.back()) - (jet.s + gap.rolling_radius())) <= 2 * gap.rounding());
  }
  return cuts;
}

/// A convex combination of the cuts.
Vector3 mean_of(const std::vector<Vector3>& cuts, std::mt19937_64& engine) {
  std::exponential_distribution<double> weight;
  Vector3 sum = Vector3::Zero();
  double weights = 0;
  for (const Vector3& cut : cuts) {
    const double share = weight(engine);
    sum += share * cut;
    weights += share;
  }
  return sum / weights;
}

void check_lemmas(const std::string& name, const RandomPair& pair, std::mt19937_64& engine) {
  GapFunction gap(*pair.shape1, {}, *pair.shape2, pair.pose2);
  const double rho = gap.rolling_radius(), rounding = 4 * gap.rounding();
  const auto seed = static_cast<unsigned>(engine());
  std::vector<Vector3> cuts = cuts_of(gap, random_normals(kCuts, seed));
  // Bodies with centres of symmetry have a cut without an evaluation.
  if (pair.shape1->traits().is_symmetric && pair.shape2->traits().is_symmetric) cuts.push_back(gap.offset());
  std::vector<Vector3> of_hull = {minimum_norm_point(cuts).point, mean_of(cuts, engine), mean_of(cuts, engine)};
  for (const Vector3& m : random_normals(kDirections, seed + 1)) {
    GapJet jet;
    gap.evaluate(m, Order::Value, jet);
    const double height = jet.s + rho;
    // Lemma 1: s(m) + rho <= m.(d(n) + rho n).
    for (const Vector3& cut : cuts) {
      if (!(height <= m.dot(cut) + rounding)) FAIL_CHECK(name, ": ", height, " above the cut ", m.dot(cut));
    }
    // Lemma 2: the same of every point p of their hull, hence s(m) + rho <= |p|.
    for (const Vector3& p : of_hull) {
      if (!(height <= m.dot(p) + rounding)) FAIL_CHECK(name, ": ", height, " above the hull's ", m.dot(p));
      if (!(height <= p.norm() + rounding)) FAIL_CHECK(name, ": ", height, " above |p| ", p.norm());
    }
  }
  // The maximum lies between every value and every bound.
  Settings certified;
  certified.certify_depth = true;
  certified.max_evaluations = 5000;
  const Proximity best = find_proximity(*pair.shape1, {}, *pair.shape2, pair.pose2, certified);
  for (const Vector3& p : of_hull) CHECK_MESSAGE(best.gap + rho <= p.norm() + rounding, name);
  if (!best.is_global) return;
  for (const Vector3& n : random_normals(kDirections, seed + 2)) {
    GapJet jet;
    gap.evaluate(n, Order::Value, jet);
    CHECK_MESSAGE(jet.s <= best.gap + best.global_error + rounding, name);
  }
}

}  // namespace

TEST_CASE("no value of the gap function is above a cut or above any point of the hull of cuts, for pairs of every kind") {
  std::mt19937_64 engine(81);
  for (const RandomKind& kind : random_kinds()) {
    RandomBodies bodies(kind, 82);
    int with_ball = 0;
    for (int k = 0; k < kPairs; ++k) {
      const double gap = k % 2 == 0 ? bodies.uniform(-0.5, 0) : bodies.uniform(0, 0.5);
      const RandomPair pair = bodies.draw(gap);
      with_ball += pair.rolling_radius() > 0;
      check_lemmas(kind.name + " " + std::to_string(k), pair, engine);
    }
    if (kind.name == "ellipsoid") CHECK(with_ball == kPairs);
  }
}
