// Tests of the reference for colliders against closed forms, the 1600 pairs with known answers and dense sampling.
#include "collider_reference.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collider_distance.hpp"
#include "collider_pairs.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/draw.hpp"
#include "support/reference_pairs.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr double kWidth = 1e-13;
constexpr double kSumRounding = 4e-15;  // for sizes up to 3
constexpr double kRadius = 0.3;
const Vector3 kLengths(1.2, 0.5, 0.8);
const Matrix3 kAttitude = Eigen::Quaterniond(0.3, -0.7, 0.2, 0.6).normalized().toRotationMatrix();

const std::vector<Vector3> kTriangle = {{-0.7, -0.4, 0.1}, {0.9, -0.5, -0.3}, {0.1, 1.1, 0.4}};

std::vector<Vector3> corners_of_box() {
  ActiveVertices corners;
  Box(kLengths).add_active_vertices(Vector3::UnitZ(), Vector3::Zero(), corners);
  std::vector<Vector3> points(static_cast<std::size_t>(corners.size()));
  for (int k = 0; k < corners.size(); ++k) points[static_cast<std::size_t>(k)] = corners[k];
  return points;
}

/// Checks in both orders, at places in and outside of the collider, which stands askew.
template <typename Distance>
void check_against_sphere(const Shape& collider, const Distance& distance) {
  const Pose pose{{0.4, -0.2, 0.1}, kAttitude};
  const Sphere sphere(kRadius);
  const Ellipsoid round(Vector3::Constant(kRadius));
  std::mt19937_64 engine(71);
  std::normal_distribution<double> gauss;
  for (int k = 0; k < 300; ++k) {
    const Vector3 place{gauss(engine), gauss(engine), gauss(engine)};
    const Pose at{pose.position + pose.rotation * place, Matrix3::Identity()};
    const double expected = distance(place) - kRadius;
    const auto check = [&](const GapBounds& bounds) {
      CHECK(bounds.upper - bounds.lower <= kWidth);
      CHECK(bounds.lower <= expected + kSumRounding);
      CHECK(bounds.upper >= expected - kSumRounding);
    };
    check(bound_gap(sphere, at, collider, pose, kWidth));
    check(bound_gap(collider, pose, round, at, kWidth));
  }
}

double s_of(const ColliderPair& pair, const Vector3& n) {
  return n.dot(pair.pose.position) - pair.body->support(n) - pair.shape->support(-(pair.pose.rotation.transpose() * n));
}

}  // namespace

TEST_CASE("reference: a sphere and a box, a capsule, a cylinder, a triangle, a hull") {
  const double radius = kLengths.x(), half_length = kLengths.y();
  const auto from_box = [](const Vector3& x) { return distance_from_box(kLengths, x); };
  check_against_sphere(Box(kLengths), from_box);
  const std::vector<Vector3> corners = corners_of_box();
  check_against_sphere(Polytope(corners), from_box);
  check_against_sphere(Capsule(radius, half_length),
                       [=](const Vector3& x) { return distance_from_capsule(radius, half_length, x); });
  check_against_sphere(Cylinder(radius, half_length),
                       [=](const Vector3& x) { return distance_from_cylinder(radius, half_length, x); });
  check_against_sphere(Polytope(kTriangle), [](const Vector3& x) { return distance_from_simplex(kTriangle, x); });
}

TEST_CASE("reference: an octahedral, a round and a boxy body standing on the edge, face and vertex of a box") {
  // The face normals are along the axes. The body's centre is above the middle of a face of the box; nothing else is nearer.
  for (const double exponent : {1.02, 2.0, 200.0}) {
    const Superellipsoid body(Vector3(0.2, 0.3, 0.1), exponent, exponent);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double gap : {-0.05, 0.0, 0.1}) {
        const Vector3 centre = Vector3::Unit(axis) * (kLengths[axis] + body.half_axes()[axis] + gap);
        const GapBounds bounds = bound_gap(body, {centre, Matrix3::Identity()}, Box(kLengths), {}, kWidth);
        CHECK(std::abs(bounds.lower - gap) <= kWidth + kSumRounding);
        CHECK(std::abs(bounds.upper - gap) <= kWidth + kSumRounding);
      }
    }
    // Edge and vertex are apart along the normal of the body's point there, which is the nearest by construction.
    for (const Vector3& n : {Vector3(1, 2, 0), Vector3(0, -1, 1), Vector3(1, 1, 1), Vector3(-0.3, 0.2, 0.5)}) {
      const Vector3 corner = n.cwiseSign().cwiseProduct(kLengths);
      const Vector3 normal = n.normalized();
      const Vector3 centre = corner + 0.07 * normal - body.point(-normal);
      const GapBounds bounds = bound_gap(body, {centre, Matrix3::Identity()}, Box(kLengths), {}, kWidth);
      CHECK(std::abs(bounds.lower - 0.07) <= kWidth + kSumRounding);
      CHECK(std::abs(bounds.upper - 0.07) <= kWidth + kSumRounding);
    }
  }
}

TEST_CASE("reference: the pairs with known answers") {
  for (const ReferencePair& pair : some_of(reference_pairs())) {
    const double width = 1e-12 * pair.unit;
    const GapBounds bounds = bound_gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, width);
    const double rounding =
        1e-15 * (pair.pose2.position.norm() + pair.surface1.half_axes().maxCoeff() + pair.surface2.half_axes().maxCoeff());
    const bool good =
        bounds.upper - bounds.lower <= width && bounds.lower <= pair.gap + rounding && bounds.upper >= pair.gap - rounding;
    if (!good) FAIL_CHECK(pair.name, " gap ", pair.gap, " between ", bounds.lower - pair.gap, " and ", bounds.upper - pair.gap);
  }
}

TEST_CASE("reference: no normal lies higher, dense around the best one and all over the sphere") {
  const std::vector<Vector3> anywhere = random_normals(2000, 72);
  for (const ColliderKind kind : kColliderKinds) {
    ColliderPairs random(kind, 73);
    for (int k = 0; k < 4; ++k) {
      for (const double gap : kColliderGaps) {
        const ColliderPair pair = random.draw(gap);
        const double ceiling = pair.reference.upper + 1e-15 * (pair.size + pair.pose.position.norm());
        const Vector3& best = pair.reference.normal;
        CHECK(std::abs(s_of(pair, best) - pair.reference.lower) <= 1e-15 * (pair.size + pair.pose.position.norm()));
        double highest = -std::numeric_limits<double>::infinity();
        double reach = 1;
        for (const Vector3& direction : anywhere) {
          highest = std::max({highest, s_of(pair, direction), s_of(pair, (best + reach * direction).normalized())});
          reach *= 0.985;  // to 1e-13
        }
        if (!(highest <= ceiling)) FAIL_CHECK(describe(pair), "\n  s ", highest);
        if (!pair.is_deep()) CHECK(std::abs(pair.reference.lower - gap * pair.unit) <= 1e-3 * pair.unit);
      }
    }
  }
}
