// Tests that cuts bound the gap function, and that maximize() finds the top of their minimum.
#include "proximity/bounds/cutting_planes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "proximity/reference_pairs.hpp"
#include "relative.hpp"
#include "shapes/shape_samples.hpp"
#include "supernormal/proximity/gap_function.hpp"

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

}  // namespace

TEST_CASE("no gap is larger than the cuts of other normals allow") {
  const std::vector<Vector3> normals = random_normals(CuttingPlanes::kCapacity, 51);
  for (const ReferencePair& pair : reference_pairs()) {
    GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    CuttingPlanes cuts;
    GapJet jet;
    for (std::size_t k = 0; k < 8; ++k) {
      gap.evaluate(normals[k], Order::Point, jet);
      cuts.add(jet.d);
    }
    for (const Vector3& n : normals) {
      gap.evaluate(n, Order::Value, jet);
      const double bound = cuts.upper_bound(n);
      if (!(jet.s <= bound + gap.rounding())) FAIL_CHECK(pair.name, " s ", jet.s, " above ", bound);
      // The bound is homogeneous: half the vector has half the bound.
      CHECK(cuts.upper_bound(0.5 * n) == 0.5 * bound);
    }
    // A cut is exact at its own normal.
    gap.evaluate(normals[3], Order::Value, jet);
    CHECK(std::abs(cuts.upper_bound(normals[3]) - jet.s) <= 2 * gap.rounding());
  }
}

TEST_CASE("the oldest cut gives way to the newest") {
  CuttingPlanes cuts;
  CHECK(cuts.size() == 0);
  CHECK(cuts.upper_bound(Vector3::UnitX()) == std::numeric_limits<double>::infinity());
  for (int k = 0; k < CuttingPlanes::kCapacity; ++k) cuts.add(Vector3::Constant(k));
  CHECK(cuts.size() == CuttingPlanes::kCapacity);
  CHECK(cuts.upper_bound(Vector3::UnitX()) == 0);
  cuts.add(Vector3::Constant(7));
  CHECK(cuts.size() == CuttingPlanes::kCapacity);
  CHECK(cuts.upper_bound(Vector3::UnitX()) == 1);
  cuts.clear();
  CHECK(cuts.size() == 0);
}

TEST_CASE("maximize goes on between cuts that are all but parallel") {
  // Two neighbouring points of a rim meet at u = 0, and both rise the same way.
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
  std::mt19937_64 engine(52);
  std::normal_distribution<double> gauss;
  int interior = 0, rim = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CuttingPlanes cuts;
    const int count = 1 + trial % 12;
    for (int k = 0; k < count; ++k) cuts.add({gauss(engine), gauss(engine), gauss(engine)});
    const TangentPlane plane(Vector3{gauss(engine), gauss(engine), gauss(engine)}.normalized(), Vector3(1, 2, -1));
    const CuttingPlanes::Maximum top = cuts.maximize(plane, kRadius);
    CHECK(top.u.norm() <= kRadius * (1 + 1e-12));
    CHECK(std::abs(top.value - model(cuts, plane, top.u)) <= 1e-10);
    (top.is_interior ? interior : rim) += 1;
    // The ascent stops where it meets the rim: a better place along the rim is allowed there, but the path never led down.
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
  // Two cuts meet at u = 0 in a ridge with a slope of 1e-3 along it; rounding is that of the steep slopes.
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

TEST_CASE("a way that is open between two cuts is found, however they are turned") {
  constexpr double kLevel = -0.7, kLeast = 1e-3;
  const TangentPlane plane(Vector3::UnitZ(), Vector3::UnitX());
  const auto side = [&](double angle, double slope) -> Vector3 {
    return kLevel * plane.n + slope * plane.lift({-std::sin(angle), std::cos(angle)});
  };
  for (int k = 0; k < 126; ++k) {
    const double turn = 0.05 * k;
    for (const double sector : {0.5, 0.1, 0.01}) {
      CuttingPlanes cuts;
      cuts.add(kLevel * plane.n);
      cuts.add(side(turn, 1.3));
      cuts.add(side(turn + sector, -0.4));
      const CuttingPlanes::Reach open = cuts.reach(plane, Vector2::Zero(), kLevel, kLeast);
      CHECK(open.distance == std::numeric_limits<double>::infinity());
      const double way = std::remainder(std::atan2(open.way.y(), open.way.x()) - turn, 2 * std::numbers::pi);
      CHECK(way >= 0);
      CHECK(way <= sector);
      // This cut closes a disc across the sector.
      cuts.add((kLevel + 0.1) * plane.n - 0.5 * plane.lift({std::cos(turn), std::sin(turn)}));
      const double stop = cuts.reach(plane, Vector2::Zero(), kLevel, kLeast).distance;
      CHECK(stop > 0.2);
      CHECK(stop < 0.3);
    }
  }
}

TEST_CASE("a way beside the edge of a closed disc is open, where the disc is narrower than what counts") {
  constexpr double kLevel = -2e-10, kLeast = 0.01;
  const TangentPlane plane(Vector3::UnitZ(), Vector3::UnitX());
  CuttingPlanes cuts;
  cuts.add(kLevel * plane.n);
  cuts.add(kLevel * plane.n + plane.lift({0, 1}));       // closes u.y < 0
  cuts.add(kLevel * plane.n + plane.lift({4, -0.04}));   // closes u.x < 0.01 u.y
  cuts.add(kLevel * plane.n + plane.lift({-1e-11, 0}));  // closes a disc that touches the line u.x = 0, as far as 0.1
  const CuttingPlanes::Reach open = cuts.reach(plane, Vector2::Zero(), kLevel, kLeast);
  CHECK(open.distance == std::numeric_limits<double>::infinity());
  CHECK(open.way.y() > 0);
  CHECK(open.way.x() > 0.01);
  CHECK(open.way.x() < kLeast / 0.1);
}
