// Tests that order, place, orientation and unit of length change results only by rounding.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/reference_pairs.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Settings that ask for rounding: reported errors are then a few units of it.
Settings tight() {
  Settings settings;
  settings.tolerance = 1e-15;
  return settings;
}

/// Only if no other maximum comes near is the answer independent of rounding.
bool has_one_answer(const ReferencePair& pair) { return pair.is_unique; }

Superellipsoid scaled(const Superellipsoid& shape, double factor) {
  return {factor * shape.half_axes(), shape.delta(), shape.epsilon()};
}

Proximity solve_scaled(const ReferencePair& pair, double factor, const Settings& settings) {
  Pose pose2 = pair.pose2;
  pose2.position *= factor;
  return find_proximity(*make_shape(scaled(pair.surface1, factor)), pair.pose1, *make_shape(scaled(pair.surface2, factor)), pose2,
                        settings);
}

bool identical(const Proximity& a, const Proximity& b) {
  return a.gap == b.gap && a.error == b.error && a.normal == b.normal && a.point1 == b.point1 && a.point2 == b.point2 &&
         a.contact == b.contact && a.evaluations == b.evaluations && a.status == b.status;
}

}  // namespace

TEST_CASE("the same query has the same answer, bit for bit") {
  for (const ReferencePair& pair : reference_pairs()) {
    const auto solve = [&] { return find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2); };
    if (!identical(solve(), solve())) FAIL_CHECK(pair.name);
  }
}

TEST_CASE("swapping the bodies swaps the answer") {
  for (const ReferencePair& pair : reference_pairs()) {
    const Proximity out = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, tight());
    const Proximity swapped = find_proximity(*pair.shape2, pair.pose2, *pair.shape1, pair.pose1, tight());
    const double difference = std::abs(out.gap - swapped.gap);
    if (!(difference <= out.error + swapped.error)) FAIL_CHECK(pair.name, " gaps differ by ", difference);
    // Both normals are within the error of the best: neither may separate better when the bodies are named as in the other query.
    const Vector3 turned = -swapped.normal;
    GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    GapJet jet;
    gap.evaluate(turned, Order::Value, jet);
    if (!(std::abs(jet.s - swapped.gap) <= 2 * gap.rounding())) FAIL_CHECK(pair.name, " s ", jet.s, " swapped ", swapped.gap);
  }
}

TEST_CASE("a pure translation by 10 km: the answer belongs to the rounded positions, bit for bit") {
  const Vector3 far(6000, -7000, 3872.983346207417);
  for (const ReferencePair& pair : reference_pairs()) {
    Pose far1 = pair.pose1, far2 = pair.pose2, near2 = pair.pose2;
    far1.position = far;
    far2.position = far + pair.pose2.position;
    near2.position = far2.position - far1.position;  // exact: no digit is left to round away
    const Proximity out = find_proximity(*pair.shape1, far1, *pair.shape2, far2);
    const Proximity expected = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, near2);
    const bool same = out.gap == expected.gap && out.error == expected.error && out.normal == expected.normal &&
                      out.evaluations == expected.evaluations && out.point1 == expected.point1 + far &&
                      out.point2 == expected.point2 + far;
    if (!same) FAIL_CHECK(pair.name, " gap ", out.gap, " instead of ", expected.gap);
  }
}

TEST_CASE("a rigid motion by 10 km changes the gap by the rounding of the positions") {
  const Vector3 far(6000, -7000, 3872.983346207417);
  const Eigen::Matrix3d turn = Eigen::Quaterniond(0.3, -0.7, 0.2, 0.6).normalized().toRotationMatrix();
  for (const ReferencePair& pair : reference_pairs()) {
    if (!has_one_answer(pair)) continue;
    Pose far1 = pair.pose1, far2 = pair.pose2;
    far1 = {far, turn};
    far2 = {far + turn * pair.pose2.position, turn * pair.pose2.rotation};
    const Proximity out = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, tight());
    const Proximity moved = find_proximity(*pair.shape1, far1, *pair.shape2, far2, tight());
    // Three coordinates, each rounded to half a unit in the last place of 10 km; the rotation to a few of 1.
    const double rounding = std::sqrt(3) * kEpsilon * 1e4 +
                            8 * kEpsilon * (pair.surface1.half_axes().maxCoeff() + pair.surface2.half_axes().maxCoeff());
    const double difference = std::abs(out.gap - moved.gap);
    if (!(difference <= rounding + out.error + moved.error)) FAIL_CHECK(pair.name, " gaps differ by ", difference);
  }
}

TEST_CASE("another unit of length, a power of two: the same digits") {
  for (const ReferencePair& pair : reference_pairs()) {
    const Proximity out = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    for (const double factor : {0x1p-10, 0x1p10, 0x1p-60}) {
      Proximity other = solve_scaled(pair, factor, {});
      other.gap /= factor;
      other.error /= factor;
      other.point1 /= factor;
      other.point2 /= factor;
      other.contact /= factor;
      if (!identical(out, other)) FAIL_CHECK(pair.name, " gap ", out.gap, " at scale ", factor, " ", other.gap);
    }
  }
}

TEST_CASE("another unit of length, 1e-3 and 1e3: the same but for rounding") {
  for (const ReferencePair& pair : reference_pairs()) {
    if (!has_one_answer(pair)) continue;
    const Proximity out = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, tight());
    for (const double factor : {1e-3, 1e3}) {
      const Proximity other = solve_scaled(pair, factor, tight());
      const double difference = std::abs(out.gap - other.gap / factor);
      if (!(difference <= out.error + other.error / factor)) FAIL_CHECK(pair.name, " gaps differ by ", difference);
    }
  }
}
