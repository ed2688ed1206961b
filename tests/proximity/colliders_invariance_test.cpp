// Tests of a body and a collider with faces and edges: place, orientation and unit of length change the answer only by rounding.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "collider_pairs.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/draw.hpp"
#include "support/reference_pairs.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr int kPairsPerGap = 30;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
const Vector3 kFar(6000, -7000, 3872.983346207417);  // 10 km

/// Calls check(pair) for some pairs of all classes.
template <typename Check>
void for_each_pair(const Check& check) {
  for (const ColliderKind kind : kColliderKinds) {
    ColliderPairs random(kind, 400 + static_cast<unsigned>(kind));
    for (int k = 0; k < draws(kPairsPerGap); ++k) {
      for (const double gap : kColliderGaps) check(random.draw(gap));
    }
  }
}

Settings tight() {
  Settings settings;
  settings.tolerance = 1e-15;
  return settings;
}

Proximity solve(const ColliderPair& pair, const Pose& body, const Pose& collider, const Settings& settings) {
  return find_proximity(*pair.body, body, *pair.shape, collider, settings);
}

/// Solves in another unit of length, and returns the answer in the old one.
Proximity solve_scaled(const ColliderPair& pair, double factor, const Settings& settings) {
  const Superellipsoid surface(factor * pair.surface.half_axes(), pair.surface.delta(), pair.surface.epsilon());
  const Collider collider = pair.collider.scaled(factor);
  const Pose pose{factor * pair.pose.position, pair.pose.rotation};
  Proximity out = find_proximity(*make_shape(surface), {}, *collider.make(), pose, settings);
  for (double* length : {&out.gap, &out.error}) *length /= factor;
  for (Eigen::Vector3d* point : {&out.point1, &out.point2, &out.contact}) *point /= factor;
  return out;
}

/// Compares digits, except for coordinates so small that a unit of length makes them denormal numbers.
bool identical(const Proximity& a, const Proximity& b) {
  const auto same = [](const Vector3& p, const Vector3& q) { return (p - q).cwiseAbs().maxCoeff() <= 1e-280; };
  return a.gap == b.gap && a.error == b.error && a.normal == b.normal && same(a.point1, b.point1) && same(a.point2, b.point2) &&
         same(a.contact, b.contact) && a.evaluations == b.evaluations && a.status == b.status;
}

}  // namespace

TEST_CASE("colliders: the same query has the same answer, bit for bit") {
  for_each_pair([](const ColliderPair& pair) {
    if (!identical(solve(pair, {}, pair.pose, {}), solve(pair, {}, pair.pose, {}))) FAIL_CHECK(describe(pair));
  });
}

TEST_CASE("colliders: 10 km away, the answer belongs to the rounded positions, bit for bit") {
  for_each_pair([](const ColliderPair& pair) {
    const Pose body{kFar, Matrix3::Identity()}, collider{kFar + pair.pose.position, pair.pose.rotation};
    const Pose rounded{collider.position - body.position, pair.pose.rotation};  // exact: no digit is left to round away
    const Proximity out = solve(pair, body, collider, {}), expected = solve(pair, {}, rounded, {});
    const bool same = out.gap == expected.gap && out.error == expected.error && out.normal == expected.normal &&
                      out.evaluations == expected.evaluations && out.point1 == expected.point1 + kFar &&
                      out.point2 == expected.point2 + kFar;
    if (!same) FAIL_CHECK(describe(pair), "\n  gap ", out.gap, " instead of ", expected.gap);
  });
}

// Deep overlaps have maxima of nearly the same height, among which rounding may decide: here and below they are left out.
TEST_CASE("colliders: a rigid motion by 10 km changes the gap by the rounding of the positions") {
  const Matrix3 turn = Eigen::Quaterniond(0.3, -0.7, 0.2, 0.6).normalized().toRotationMatrix();
  for_each_pair([&](const ColliderPair& pair) {
    if (pair.is_deep()) return;
    const Pose body{kFar, turn}, collider{kFar + turn * pair.pose.position, turn * pair.pose.rotation};
    const Proximity out = solve(pair, {}, pair.pose, tight()), moved = solve(pair, body, collider, tight());
    // Three coordinates, each rounded to half a unit in the last place of 10 km; the rotation to a few of 1.
    const double rounding = std::sqrt(3) * kEpsilon * 1e4 + 8 * kEpsilon * pair.size;
    const double difference = std::abs(out.gap - moved.gap);
    if (!(difference <= rounding + out.error + moved.error)) FAIL_CHECK(describe(pair), "\n  gaps differ by ", difference);
  });
}

TEST_CASE("colliders: another unit of length, a power of two: the same digits") {
  for_each_pair([](const ColliderPair& pair) {
    const Proximity out = solve(pair, {}, pair.pose, {});
    for (const double factor : {0x1p-10, 0x1p10, 0x1p-60}) {
      const Proximity other = solve_scaled(pair, factor, {});
      if (!identical(out, other)) FAIL_CHECK(describe(pair), "\n  gap ", out.gap, " at scale ", factor, " ", other.gap);
    }
  });
}

TEST_CASE("colliders: another unit of length, 1e-3 and 1e3: the same but for rounding") {
  for_each_pair([](const ColliderPair& pair) {
    if (pair.is_deep()) return;
    const Proximity out = solve(pair, {}, pair.pose, tight());
    for (const double factor : {1e-3, 1e3}) {
      const Proximity other = solve_scaled(pair, factor, tight());
      const double difference = std::abs(out.gap - other.gap);
      if (!(difference <= out.error + other.error)) FAIL_CHECK(describe(pair), "\n  gaps differ by ", difference);
    }
  });
}
