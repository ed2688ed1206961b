// Smooth bodies against colliders with faces and edges: the contract, for 2030 random pairs of every class.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collider_distance.hpp"
#include "collider_pairs.hpp"
#include "covers.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/reference_pairs.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr int kPairsPerGap = 290;  // 2030 of each class
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kExact = 1e-9;         // of the unit: what is promised
constexpr double kMissedShare = 0.005;  // of the deep ones
constexpr double kMissedMost = 1e-3;    // of the unit

Proximity solve(const ColliderPair& pair, const Settings& settings = {}) {
  return find_proximity(*pair.body, {}, *pair.shape, pair.pose, settings);
}

Proximity solve_swapped(const ColliderPair& pair, const Settings& settings = {}) {
  return find_proximity(*pair.shape, pair.pose, *pair.body, {}, settings);
}

/// s may be off by this: support functions and products are good to a few units in the last place of what they are of.
double rounding(const ColliderPair& pair) { return 16 * kEpsilon * (pair.size + pair.pose.position.norm()); }

struct Counts {
  int pairs = 0, deep = 0, missed = 0;
  double worst = 0, worst_missed = 0;  // of the unit
  std::vector<int> near, all;          // evaluations; near: apart or touching
};

struct Cost {
  int median, most;  // most: 99th percentile
};

Cost cost_of(std::vector<int> evaluations) {
  std::sort(evaluations.begin(), evaluations.end());
  return {evaluations[evaluations.size() / 2], evaluations[evaluations.size() * 99 / 100]};
}

void check_gap(const ColliderPair& pair, const Proximity& out, Counts& counts) {
  const GapBounds& reference = pair.reference;
  if (!(reference.upper - reference.lower <= kReferenceWidth * pair.unit + rounding(pair)))
    FAIL_CHECK(describe(pair), "\n  the reference is ", reference.upper - reference.lower, " wide");
  const bool is_proved = must_be_proved(GapFunction(*pair.body, {}, *pair.shape, pair.pose), {}, out.gap);
  if (is_proved && !(out.status == Status::Converged && out.is_global))
    FAIL_CHECK(describe(pair), "\n  status ", static_cast<int>(out.status), " global ", out.is_global);
  if (!(out.gap <= reference.upper + rounding(pair))) FAIL_CHECK(describe(pair), "\n  gap ", out.gap, " is above the maximum");
  if (!(reference.lower <= out.gap + out.global_error + rounding(pair)))
    FAIL_CHECK(describe(pair), "\n  gap ", out.gap, " to ", out.gap + out.global_error, " is below the maximum");
  if (is_proved && !(out.error <= kExact * pair.unit)) FAIL_CHECK(describe(pair), "\n  reported error ", out.error);
  const double error = std::max(reference.lower - out.gap, 0.0) / pair.unit;
  if (error > kExact) {
    const std::string text = describe(pair) + "\n  missed by " + std::to_string(error) + " of the unit";
    if (!pair.is_deep()) {
      FAIL_CHECK(text, ", gap ", out.gap, " evaluations ", out.evaluations);
    } else {
      MESSAGE(text, ", gap ", out.gap, " evaluations ", out.evaluations);
      ++counts.missed;
      counts.worst_missed = std::max(counts.worst_missed, error);
    }
    return;
  }
  counts.worst = std::max(counts.worst, error);
  const double beyond = reference.lower - out.gap - out.error - rounding(pair);
  if (is_proved && beyond > 0)
    FAIL_CHECK(describe(pair), "\n  gap ", out.gap, " reported error ", out.error, " exceeded by ", beyond);
}

/// Extreme along the normal in both bodies, on their boundaries, and a gap apart.
void check_witness_points(const ColliderPair& pair, const Proximity& out) {
  const double tolerance = rounding(pair);
  const Vector3 in_collider = pair.pose.rotation.transpose() * (out.point2 - pair.pose.position);
  const Vector3 normal2 = -(pair.pose.rotation.transpose() * out.normal);
  const double off_surface = std::abs(gauge(pair.surface, out.point1) - 1) * pair.surface.half_axes().minCoeff();
  const double off_plane1 = std::abs(out.normal.dot(out.point1) - pair.body->support(out.normal));
  const double off_plane2 = std::abs(normal2.dot(in_collider) - pair.shape->support(normal2));
  const double off_collider = distance_from_extreme_part(pair.collider, normal2, in_collider, tolerance);
  const double off_gap = std::abs((out.point2 - out.point1).dot(out.normal) - out.gap);
  const double off_unit = std::abs(out.normal.norm() - 1);
  const bool good = off_surface <= tolerance && off_plane1 <= tolerance && off_plane2 <= tolerance && off_collider <= tolerance &&
                    off_gap <= tolerance && off_unit <= 4e-16;
  if (!good) {
    FAIL_CHECK(describe(pair), "\n  body's surface missed by ", off_surface, ", planes by ", off_plane1, " and ", off_plane2,
               ", collider by ", off_collider, ", gap by ", off_gap, ", unit length by ", off_unit);
  }
  const double distance = (out.point2 - out.point1).norm();
  if (out.gap > 0 && !(distance >= out.gap - tolerance)) FAIL_CHECK(describe(pair), "\n  points ", distance, " apart");
}

void check_swapped(const ColliderPair& pair, const Proximity& out) {
  const Proximity swapped = solve_swapped(pair);
  // Within their errors where these are bounds; elsewhere their intervals have the maximum in common.
  const bool are_global = out.is_global && swapped.is_global;
  const bool same = are_global ? std::abs(swapped.gap - out.gap) <= out.error + swapped.error
                               : swapped.gap <= out.gap + out.global_error && out.gap <= swapped.gap + swapped.global_error;
  // Two normals that are both within the error of the best.
  GapFunction gap(*pair.body, {}, *pair.shape, pair.pose);
  GapJet jet;
  gap.evaluate(-swapped.normal, Order::Value, jet);
  const bool reversed = std::abs(jet.s - swapped.gap) <= rounding(pair);
  const bool points = std::abs((swapped.point1 - swapped.point2).dot(-swapped.normal) - swapped.gap) <= rounding(pair);
  if (!(same && reversed && points)) {
    FAIL_CHECK(describe(pair), "\n  gap ", out.gap, " swapped ", swapped.gap, " reversed ", reversed, " points ", points);
  }
}

void check_class(ColliderKind kind) {
  Counts counts;
  const auto check = [&](const ColliderPair& pair) {
    const Proximity out = solve(pair);
    check_gap(pair, out, counts);
    check_witness_points(pair, out);
    check_swapped(pair, out);
    ++counts.pairs;
    counts.deep += pair.is_deep();
    counts.all.push_back(out.evaluations);
    if (pair.nominal >= 0) counts.near.push_back(out.evaluations);
  };
  ColliderPairs random(kind, 300 + static_cast<unsigned>(kind));
  for (int k = 0; k < kPairsPerGap; ++k) {
    for (const double gap : kColliderGaps) check(random.draw(gap));
  }
  const Cost near = cost_of(counts.near), all = cost_of(counts.all);
  MESSAGE(std::string(name_of(kind)), ": ", counts.pairs, " pairs, largest error ", counts.worst, " of the unit; ", counts.missed,
          " of ", counts.deep, " deep ones missed, by up to ", counts.worst_missed);
  MESSAGE(std::string(name_of(kind)), ": evaluations, median and 99th percentile: ", near.median, " and ", near.most,
          " apart or touching, ", all.median, " and ", all.most, " of all");
  CHECK(counts.pairs >= 2000);
  CHECK(counts.missed <= kMissedShare * counts.deep);
  CHECK(counts.worst_missed <= kMissedMost);
  CHECK(near.median <= 6);
  CHECK(near.most <= 30);
  CHECK(all.median <= 8);
  CHECK(all.most <= 120);  // other maxima are looked for
}

}  // namespace

TEST_CASE("2030 random pairs with boxes") { check_class(ColliderKind::Box); }
TEST_CASE("2030 random pairs with capsules") { check_class(ColliderKind::Capsule); }
TEST_CASE("2030 random pairs with cylinders") { check_class(ColliderKind::Cylinder); }
TEST_CASE("2030 random pairs with triangles") { check_class(ColliderKind::Triangle); }
TEST_CASE("2030 random pairs with hulls") { check_class(ColliderKind::Hull); }

TEST_CASE("a box in a flat body, aligned but for rounding: the gap belongs to the normal") {
  const Box box({0.0637, 0.6113, 2.1592});
  const Superellipsoid flat({4.2668, 1.3804, 0.1145}, 41, 97);
  double tilt = 1e-16;
  for (const Vector3& axis : random_normals(400, 91)) {
    tilt = tilt < 1e-10 ? 1.1 * tilt : 1e-16;
    const Pose pose{1e-9 * axis, Eigen::AngleAxisd(tilt, axis).toRotationMatrix()};
    const Proximity out = find_proximity(flat, {}, box, pose);
    GapFunction gap(flat, {}, box, pose);
    GapJet jet;
    gap.evaluate(out.normal, Order::Value, jet);
    CHECK(std::abs(jet.s - out.gap) <= gap.rounding());
  }
}
