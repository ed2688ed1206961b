// The ways across flat spots near a normal.
#include "proximity/local/degenerate_directions.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

using namespace supernormal;

namespace {

const Superellipsoid kFlat({1, 1, 1}, 2.03, 2.03);
const Ellipsoid kRound({1, 2, 3});

/// In body 1's frame.
std::vector<Vector3> ways_at(const Shape& shape1, const Shape& shape2, const Vector3& n, double distance,
                             const Matrix3& rotation2 = Matrix3::Identity()) {
  GapFunction gap(shape1, {}, shape2, {Vector3(0, 0, 1.9), rotation2});
  GapJet jet;
  gap.evaluate(n.normalized(), Order::Hessian, jet);
  const LocalModel local = LocalModel::of(gap, jet);
  std::vector<Vector3> ways;
  const DegenerateDirections across(gap, local, distance);
  for (const Vector2& way : across.ways()) {
    CHECK(std::abs(way.norm() - 1) <= 1e-15);
    ways.push_back(local.plane1.lift(way));
  }
  return ways;
}

}  // namespace

TEST_CASE("ways lead across the planes of symmetry that are near, of bodies with flat faces only") {
  CHECK(ways_at(kFlat, kRound, {1e-4, 0.6, 0.8}, 1e-3).size() == 1);
  CHECK(ways_at(kFlat, kRound, {1e-4, 0.6, 0.8}, 1e-5).empty());
  CHECK(ways_at(kRound, kFlat, {1e-4, 0.6, 0.8}, 1e-3).size() == 1);
  CHECK(ways_at(kFlat, kFlat, {1e-4, 0.6, 0.8}, 1e-3).size() == 2);
  CHECK(ways_at(kFlat, kFlat, {1e-4, 1e-4, 1}, 1e-3).size() == 4);
  CHECK(ways_at(kRound, kRound, {0, 0, 1}, 1e-3).empty());
  CHECK(ways_at(kFlat, kRound, {0.5, 0.6, 0.8}, 2).empty());
}

TEST_CASE("a way leads along the axis of the body whose plane is near") {
  Matrix3 quarter;  // about z
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const std::vector<Vector3> ways = ways_at(kRound, kFlat, {0.6, 0, 0.8}, 1e-3, quarter);
  REQUIRE(ways.size() == 1);
  CHECK(std::abs(std::abs(ways[0].y()) - 1) <= 1e-15);
}

TEST_CASE("a radius of curvature like that of a flat face tells, on any plane") {
  CHECK(ways_at(Superellipsoid({1, 1, 1}, 20, 20), kRound, {0, 0, 1}, 1e-3).size() == 4);
}
