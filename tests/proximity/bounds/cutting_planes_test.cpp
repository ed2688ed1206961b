// Cuts bound the gap function, and maximize() finds the top of their minimum.
#include "proximity/bounds/cutting_planes.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "proximity/bounds/minimum_norm_point.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/draw.hpp"
#include "support/random_bodies.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr double kRadius = 0.8;

double model(const CuttingPlanes& cuts, const TangentPlane& plane, const Vector2& u) {
  return cuts.upper_bound(plane.n + plane.lift(u));
}

/// The largest value on a grid in polar coordinates around `centre`, in the disc of kRadius.
double largest_sampled(const CuttingPlanes& cuts, const TangentPlane& plane, const Vector2& centre, double reach) {
  double largest = -std::numeric_limits<double>::infinity();
  for (int ring = 0; ring <= 60; ++ring) {
    for (int spoke = 0; spoke < 120; ++spoke) {
      const double angle = 2 * std::numbers::pi * spoke / 120;
      const Vector2 u = centre + reach * ring / 60.0 * Vector2(std::cos(angle), std::sin(angle));
      if (u.norm() <= kRadius) largest = std::max(largest, model(cuts, plane, u));
    }
  }
  return largest;
}

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
  CuttingPlanes planes;
  for (const Vector3& cut : cuts) planes.add(cut);
  for (const Vector3& m : random_normals(kDirections, seed + 1)) {
    GapJet jet;
    gap.evaluate(m, Order::Value, jet);
    const double height = jet.s + rho;
    // Lemma 1: s(m) + rho <= m.(d(n) + rho n).
    const double bound = planes.upper_bound(m);
    if (!(height <= bound + rounding)) FAIL_CHECK(name, ": ", height, " above a cut ", bound);
    CHECK(planes.upper_bound(0.5 * m) == 0.5 * bound);  // homogeneous: half the vector, half the bound
    // Lemma 2: the same of every point p of their hull, hence s(m) + rho <= |p|.
    for (const Vector3& p : of_hull) {
      if (!(height <= m.dot(p) + rounding)) FAIL_CHECK(name, ": ", height, " above the hull's ", m.dot(p));
      if (!(height <= p.norm() + rounding)) FAIL_CHECK(name, ": ", height, " above |p| ", p.norm());
    }
  }
  // The maximum lies between every value and every bound.
  const Settings certified{.max_evaluations = 5000, .certify_depth = true};
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

TEST_CASE("the centre's cut stays, and is no boundary point") {
  CuttingPlanes cuts;
  cuts.set_centre(Vector3(-1, 5, 5));
  for (int k = 0; k < 2 * CuttingPlanes::kCapacity; ++k) {
    CHECK(cuts.boundary_points().size() == static_cast<std::size_t>(std::min(k, CuttingPlanes::kCapacity)));
    CHECK(cuts.points().size() == cuts.boundary_points().size() + 1);
    CHECK(cuts.upper_bound(Vector3::UnitX()) == -1);
    cuts.add(Vector3::Constant(k));
  }
  CHECK(std::ranges::find(cuts.boundary_points(), Vector3(-1, 5, 5)) == cuts.boundary_points().end());
}

TEST_CASE("the oldest cut gives way to the newest") {
  CuttingPlanes cuts;
  CHECK(cuts.points().empty());
  CHECK(cuts.upper_bound(Vector3::UnitX()) == std::numeric_limits<double>::infinity());
  for (int k = 0; k < CuttingPlanes::kCapacity; ++k) cuts.add(Vector3::Constant(k));
  CHECK(cuts.points().size() == CuttingPlanes::kCapacity);
  CHECK(cuts.upper_bound(Vector3::UnitX()) == 0);
  cuts.add(Vector3::Constant(7));
  CHECK(cuts.points().size() == CuttingPlanes::kCapacity);
  CHECK(cuts.upper_bound(Vector3::UnitX()) == 1);
  CHECK(CuttingPlanes().points().empty());
}

TEST_CASE("the cuts that are lowest at the kept normal stay, however many are added") {
  Draw draw(53);
  CuttingPlanes cuts;
  std::vector<Vector3> all;
  const auto add = [&] {
    all.emplace_back(Vector3{draw.gauss(), draw.gauss(), draw.gauss()});
    cuts.add(all.back());
  };
  for (int k = 0; k < CuttingPlanes::kCapacity; ++k) add();
  const Vector3 kept = Vector3(2, -1, 0.5).normalized();
  cuts.keep_lowest_at(kept);
  for (int k = 0; k < 3 * CuttingPlanes::kCapacity; ++k) {
    add();
    REQUIRE(cuts.points().size() == CuttingPlanes::kCapacity);
    // All but one of the places belong to the lowest of all; the newest cut is there whatever its height.
    std::vector<Vector3> lowest = all;
    std::ranges::sort(lowest, {}, [&](const Vector3& d) { return kept.dot(d); });
    const auto holds = [&](const Vector3& d) { return std::ranges::find(cuts.points(), d) != cuts.points().end(); };
    CHECK(holds(all.back()));
    CHECK(std::all_of(lowest.begin(), lowest.begin() + CuttingPlanes::kCapacity - 1, holds));
    CHECK(cuts.upper_bound(kept) == kept.dot(lowest.front()));
  }
}

TEST_CASE("another kept normal changes which cuts stay") {
  CuttingPlanes cuts;
  for (int k = 0; k < CuttingPlanes::kCapacity; ++k) cuts.add({static_cast<double>(k), static_cast<double>(-k), 0});
  cuts.keep_lowest_at(Vector3::UnitX());
  cuts.add(Vector3(0.5, 0.5, 0));  // in place of the highest along x, which is the lowest along y
  CHECK(cuts.upper_bound(Vector3::UnitX()) == 0);
  CHECK(cuts.upper_bound(Vector3::UnitY()) == 2 - CuttingPlanes::kCapacity);
  cuts.keep_lowest_at(Vector3::UnitY());
  cuts.add(Vector3(0.25, 0.25, 0));  // in place of the highest along y: the one before
  CHECK(cuts.upper_bound(Vector3::UnitX()) == 0);
  CHECK(cuts.upper_bound(Vector3::UnitY()) == 2 - CuttingPlanes::kCapacity);
  CHECK(std::ranges::find(cuts.points(), Vector3(0.5, 0.5, 0)) == cuts.points().end());
}

TEST_CASE("maximize goes on between cuts that are all but parallel") {
  // Two neighbouring points of a curved edge, which meet at u = 0: both rise the same way.
  constexpr double kRim = 1.104;
  for (int k = 0; k < 200; ++k) {
    const double angle = 0.01 * k;
    const double next = angle + 1e-3 * std::pow(0.93, k);
    CuttingPlanes cuts;
    cuts.add({kRim * std::cos(angle), kRim * std::sin(angle), -1e-5});
    cuts.add({kRim * std::cos(next), kRim * std::sin(next), -1e-5});
    const CuttingPlanes::Maximum top = cuts.maximize(TangentPlane(Vector3::UnitZ(), Vector3::UnitX()), kRadius);
    CHECK_FALSE(top.is_interior);
    CHECK(top.value == relative(kRim * kRadius - 1e-5));
  }
}

TEST_CASE("maximize goes on where a cut is a hundred times as steep as the other") {
  CuttingPlanes cuts;
  cuts.add({-6.7806492628541723e-07, 1.7572213680683304e-07, 2.8789703921842099e-08});
  cuts.add({4.1131333020573496e-06, 9.8238256637858385e-06, 2.7945714024860285e-06});
  cuts.add({-2.1595809732447227e-09, -7.9493604957776414e-09, 2.8789556600387378e-08});
  const CuttingPlanes::Maximum top = cuts.maximize(TangentPlane(Vector3::UnitZ(), Vector3::UnitX()), kRadius);
  CHECK(top.value >= 2.9e-08);
}

TEST_CASE("maximize finds the top of random cuts") {
  Draw draw(52);
  int interior = 0, rim = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CuttingPlanes cuts;
    const int count = 1 + trial % 12;
    for (int k = 0; k < count; ++k) cuts.add({draw.gauss(), draw.gauss(), draw.gauss()});
    const TangentPlane plane(draw.direction(), Vector3(1, 2, -1));
    const CuttingPlanes::Maximum top = cuts.maximize(plane, kRadius);
    CHECK(top.u.norm() <= kRadius * (1 + 1e-12));
    CHECK(std::abs(top.value - model(cuts, plane, top.u)) <= 1e-10);
    (top.is_interior ? interior : rim) += 1;
    // The ascent stops where it meets the circle: a better place along the circle is allowed there, but the way up never led down.
    CHECK(top.value >= model(cuts, plane, Vector2::Zero()) - 1e-12);
    if (!top.is_interior) {
      CHECK(top.u.norm() >= kRadius * (1 - 1e-12));
      continue;
    }
    CHECK(top.value >= largest_sampled(cuts, plane, Vector2::Zero(), kRadius) - 1e-10);
    CHECK(top.value >= largest_sampled(cuts, plane, top.u, 1e-3) - 1e-10);
  }
  CHECK(interior > 50);
  CHECK(rim > 50);
}

TEST_CASE("cuts of a flat face, steep one way and gentle the other, are climbed along the gentle one") {
  // Two cuts meet at u = 0 in a ridge with a slope of 1e-3 along it; the steep slopes set the rounding.
  const TangentPlane plane(Vector3(2, -1, 0.5).normalized(), Vector3(1, 1, 1));
  for (const double slope : {1e-1, 1e-3, 1e-6, 1e-9}) {
    CuttingPlanes cuts;
    cuts.add(plane.lift({2.27, slope}));
    cuts.add(plane.lift({-2.09, slope}));
    const CuttingPlanes::Maximum top = cuts.maximize(plane, kRadius);
    CHECK_FALSE(top.is_interior);
    CHECK(std::abs(top.value - slope * kRadius) <= 1e-6 * slope * kRadius + 1e-15);
  }
}

TEST_CASE("maximize goes on where the gentle cut is all but across a steep one") {
  // Whether the ridge of the two rises along the gentle slope or beside it is less than the rounding of the steep one.
  const TangentPlane plane(Vector3::UnitZ(), Vector3::UnitX());
  CuttingPlanes cuts;
  cuts.add(3.68e-5 * plane.n + plane.lift({-1.5504933237218308, -2.9551042409240947e-07}));
  cuts.add(3.68e-5 * plane.n + plane.lift({2.6352787137355293e-16, -2.9455823693878426e-07}));
  const CuttingPlanes::Maximum top = cuts.maximize(plane, kRadius);
  CHECK_FALSE(top.is_interior);
  CHECK(top.value == relative(3.68e-5 + 2.9455823693878426e-07 * kRadius));
}

TEST_CASE("one level cut has its maximum where it stands") {
  const TangentPlane plane(Vector3::UnitZ(), Vector3::UnitX());
  CuttingPlanes cuts;
  cuts.add(3 * Vector3::UnitZ());
  const CuttingPlanes::Maximum top = cuts.maximize(plane, kRadius);
  CHECK(top.is_interior);
  CHECK(top.value == 3);
  CHECK(top.u == Vector2::Zero());
}

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
