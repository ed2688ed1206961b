// The ways across flat spots near a normal.
#include "solvers/flat_spots.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

using namespace supernormal;

namespace {

const Superellipsoid kFlat({1, 1, 1}, 2.03, 2.03);
const Ellipsoid kRound({1, 2, 3});

std::size_t ways_at(const Shape& shape1, const Shape& shape2, const Matrix3& rotation2, const Vector3& n, double distance) {
  GapFunction gap(shape1, {}, shape2, {Vector3(0, 0, 1.9), rotation2});
  GapJet jet;
  gap.evaluate(n.normalized(), Order::Curvature, jet);
  const LocalModel local = LocalModel::of(gap, jet);
  const WaysAcrossFlatSpots across(gap, local, distance);
  for (const Vector2& way : across.ways()) CHECK(std::abs(way.norm() - 1) <= 1e-15);
  return across.ways().size();
}

}  // namespace

TEST_CASE("ways lead across the planes of symmetry that are near, of bodies with flat faces only") {
  const Matrix3 upright = Matrix3::Identity();
  CHECK(ways_at(kFlat, kRound, upright, {1e-4, 0.6, 0.8}, 1e-3) == 1);
  CHECK(ways_at(kFlat, kRound, upright, {1e-4, 0.6, 0.8}, 1e-5) == 0);
  CHECK(ways_at(kRound, kFlat, upright, {1e-4, 0.6, 0.8}, 1e-3) == 1);
  CHECK(ways_at(kFlat, kFlat, upright, {1e-4, 0.6, 0.8}, 1e-3) == 2);
  CHECK(ways_at(kFlat, kFlat, upright, {1e-4, 1e-4, 1}, 1e-3) == 4);
  CHECK(ways_at(kRound, kRound, upright, {0, 0, 1}, 1e-3) == 0);
  CHECK(ways_at(kFlat, kRound, upright, {0.5, 0.6, 0.8}, 2) == 0);
}

TEST_CASE("a way leads along the axis of the body whose plane is near") {
  Matrix3 quarter;  // about z
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  GapFunction gap(kRound, {}, kFlat, {Vector3(0, 0, 1.9), quarter});
  GapJet jet;
  gap.evaluate(Vector3(0.6, 0, 0.8), Order::Curvature, jet);
  const LocalModel local = LocalModel::of(gap, jet);
  const WaysAcrossFlatSpots across(gap, local, 1e-3);
  REQUIRE(across.ways().size() == 1);
  CHECK(std::abs(std::abs(local.plane1.lift(across.ways()[0]).y()) - 1) <= 1e-15);
}

TEST_CASE("a radius of curvature like that of a flat face tells, on any plane") {
  CHECK(ways_at(Superellipsoid({1, 1, 1}, 20, 20), kRound, Matrix3::Identity(), {0, 0, 1}, 1e-3) == 4);
}
