// Tests that order, place, orientation and unit of length change results only by rounding: for the reference pairs, and for bodies
// and colliders with faces and edges.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "collider_pairs.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/draw.hpp"
#include "support/reference_pairs.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr int kPairsPerGap = 30;  // of a class of colliders
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
const Vector3 kFar(6000, -7000, 3872.983346207417);  // 10 km
const Matrix3 kTurn = Eigen::Quaterniond(0.3, -0.7, 0.2, 0.6).normalized().toRotationMatrix();

/// Settings that ask for rounding: reported errors are then a few units of it.
Settings tight() {
  Settings settings;
  settings.tolerance = 1e-15;
  return settings;
}

/// Two bodies, the first one at rest in the origin.
struct Bodies {
  const Shape &shape1, &shape2;
  Pose pose2;
  double size;          // m; of the numbers that s is the difference of
  bool has_one_answer;  // no other maximum comes near, so that rounding does not decide between answers
  std::function<Proximity(double factor, const Settings& settings)> solve_scaled;
  std::function<std::string()> name;

  Proximity solve(const Pose& one, const Pose& two, const Settings& settings = {}) const {
    return find_proximity(shape1, one, shape2, two, settings);
  }
  Proximity solve(const Settings& settings = {}) const { return solve({}, pose2, settings); }
  /// Solves in another unit of length, and returns the answer in the old one.
  Proximity solve_in_unit(double factor, const Settings& settings = {}) const {
    Proximity out = solve_scaled(factor, settings);
    for (double* length : {&out.gap, &out.error}) *length /= factor;
    for (Vector3* point : {&out.point1, &out.point2, &out.contact}) *point /= factor;
    return out;
  }
};

std::shared_ptr<const Shape> scaled(const Superellipsoid& shape, double factor) {
  return make_shape(Superellipsoid(factor * shape.half_axes(), shape.delta(), shape.epsilon()));
}

/// Calls check(bodies) for the reference pairs, and for some pairs of all classes of colliders.
template <typename Check>
void for_each_pair(const Check& check) {
  for (const ReferencePair& pair : reference_pairs()) {
    const double size = pair.surface1.half_axes().maxCoeff() + pair.surface2.half_axes().maxCoeff();
    const auto solve_scaled = [&](double factor, const Settings& settings) {
      const Pose pose2{factor * pair.pose2.position, pair.pose2.rotation};
      return find_proximity(*scaled(pair.surface1, factor), {}, *scaled(pair.surface2, factor), pose2, settings);
    };
    check(Bodies{*pair.shape1, *pair.shape2, pair.pose2, size, pair.is_unique, solve_scaled, [&] { return pair.name; }});
  }
  for (const ColliderKind kind : kColliderKinds) {
    ColliderPairs random(kind, 400 + static_cast<unsigned>(kind));
    for (int k = 0; k < draws(kPairsPerGap); ++k) {
      for (const double gap : kColliderGaps) {
        const ColliderPair pair = random.draw(gap);
        const auto solve_scaled = [&](double factor, const Settings& settings) {
          const Collider collider = pair.collider.scaled(factor);
          const Pose pose2{factor * pair.pose.position, pair.pose.rotation};
          return find_proximity(*scaled(pair.surface, factor), {}, *collider.make(), pose2, settings);
        };
        // Deep overlaps have maxima of nearly the same height.
        check(Bodies{*pair.body, *pair.shape, pair.pose, pair.size, !pair.is_deep(), solve_scaled, [&] { return describe(pair); }});
      }
    }
  }
}

/// Compares digits, except for coordinates so small that a unit of length makes them denormal numbers.
bool identical(const Proximity& a, const Proximity& b) {
  const auto same = [](const Vector3& p, const Vector3& q) { return (p - q).cwiseAbs().maxCoeff() <= 1e-280; };
  return a.gap == b.gap && a.error == b.error && a.normal == b.normal && same(a.point1, b.point1) && same(a.point2, b.point2) &&
         same(a.contact, b.contact) && a.evaluations == b.evaluations && a.status == b.status;
}

}  // namespace

TEST_CASE("the same query has the same answer, bit for bit") {
  for_each_pair([](const Bodies& pair) {
    if (!identical(pair.solve(), pair.solve())) FAIL_CHECK(pair.name());
  });
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
  for_each_pair([](const Bodies& pair) {
    const Pose one{kFar, Matrix3::Identity()}, two{kFar + pair.pose2.position, pair.pose2.rotation};
    const Pose rounded{two.position - one.position, two.rotation};  // exact: no digit is left to round away
    const Proximity out = pair.solve(one, two), expected = pair.solve({}, rounded);
    const bool same = out.gap == expected.gap && out.error == expected.error && out.normal == expected.normal &&
                      out.evaluations == expected.evaluations && out.point1 == expected.point1 + kFar &&
                      out.point2 == expected.point2 + kFar;
    if (!same) FAIL_CHECK(pair.name(), "\n  gap ", out.gap, " instead of ", expected.gap);
  });
}

TEST_CASE("a rigid motion by 10 km changes the gap by the rounding of the positions") {
  for_each_pair([](const Bodies& pair) {
    if (!pair.has_one_answer) return;
    const Pose one{kFar, kTurn}, two{kFar + kTurn * pair.pose2.position, kTurn * pair.pose2.rotation};
    const Proximity out = pair.solve(tight()), moved = pair.solve(one, two, tight());
    // Three coordinates, each rounded to half a unit in the last place of 10 km; the rotation to a few of 1.
    const double rounding = std::sqrt(3) * kEpsilon * 1e4 + 8 * kEpsilon * pair.size;
    const double difference = std::abs(out.gap - moved.gap);
    if (!(difference <= rounding + out.error + moved.error)) FAIL_CHECK(pair.name(), "\n  gaps differ by ", difference);
  });
}

TEST_CASE("another unit of length, a power of two: the same digits") {
  for_each_pair([](const Bodies& pair) {
    const Proximity out = pair.solve();
    for (const double factor : {0x1p-10, 0x1p10, 0x1p-60}) {
      const Proximity other = pair.solve_in_unit(factor);
      if (!identical(out, other)) FAIL_CHECK(pair.name(), "\n  gap ", out.gap, " at scale ", factor, " ", other.gap);
    }
  });
}

TEST_CASE("another unit of length, 1e-3 and 1e3: the same but for rounding") {
  for_each_pair([](const Bodies& pair) {
    if (!pair.has_one_answer) return;
    const Proximity out = pair.solve(tight());
    for (const double factor : {1e-3, 1e3}) {
      const Proximity other = pair.solve_in_unit(factor, tight());
      const double difference = std::abs(out.gap - other.gap);
      if (!(difference <= out.error + other.error)) FAIL_CHECK(pair.name(), "\n  gaps differ by ", difference);
    }
  });
}
