// Tests of the contact manifold, the points on which flat bodies rest.
#include "supernormal/contact/contact_manifold.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/raycast/ray.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"
#include "support/relative.hpp"

using namespace supernormal;

namespace {

// Tolerance of repeated manifold points, relative to the extent of the body. On a flat face the support point, to which they refer,
// depends on the last digits of the normal.
constexpr double kCornerTolerance = 1e-3;

Matrix3 tilt(double angle, double direction) {
  return Eigen::AngleAxisd(angle, Vector3(std::cos(direction), std::sin(direction), 0)).toRotationMatrix();
}

/// The manifold of a body that overlaps the plane z = 0 by `depth`.
ContactManifold manifold_on_floor(const Shape& shape, const Matrix3& rotation, double depth, Pose* pose_out = nullptr) {
  Pose pose{Vector3(0.3, -0.2, 0), rotation};
  pose.position.z() = -find_plane_proximity(shape, pose, Vector3::UnitZ(), 0).gap - depth;
  if (pose_out != nullptr) *pose_out = pose;
  return find_plane_contact_manifold(shape, pose, find_plane_proximity(shape, pose, Vector3::UnitZ(), 0));
}

/// The manifold of two bodies with parallel faces. The second lies on top of the first, shifted by (x, y), and overlaps it by
/// `depth`.
ContactManifold manifold_of_stacked(const Shape& lower, const Shape& upper, double x, double y, double turn, double depth) {
  const Pose pose1;
  const Pose pose2{Vector3(x, y, lower.half_extents().z() + upper.half_extents().z() - depth),
                   Eigen::AngleAxisd(turn, Vector3::UnitZ()).toRotationMatrix()};
  return find_contact_manifold(lower, pose1, upper, pose2, find_proximity(lower, pose1, upper, pose2));
}

/// The largest distance of a point of one manifold from the nearest point of the other.
double distance_of_corners(const ContactManifold& a, const ContactManifold& b) {
  double largest = 0;
  for (int i = 0; i < a.corner_count; ++i) {
    double nearest = HUGE_VAL;
    for (int k = 0; k < b.corner_count; ++k) {
      nearest =
          std::min(nearest, (a.corners[static_cast<std::size_t>(i)].point - b.corners[static_cast<std::size_t>(k)].point).norm());
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

}  // namespace

TEST_CASE("ellipsoids have one contact at any depth") {
  test::Draw random(1);
  for (int repetition = 0; repetition < 500; ++repetition) {
    const Ellipsoid first(random.within(0.2, 1));
    const Ellipsoid second(random.within(0.2, 3));
    const double depth = 0.2 * std::pow(10, random.uniform(-6, 0));
    CHECK(manifold_on_floor(first, random.rotation(), depth).corner_count == 0);
    const Pose pose1{Vector3::Zero(), random.rotation()};
    Pose pose2{Vector3{random.uniform(-1, 1), random.uniform(-1, 1), 5}, random.rotation()};
    const Proximity apart = find_proximity(first, pose1, second, pose2);
    pose2.position -= (apart.gap + depth) * apart.normal;
    const ContactManifold manifold =
        find_contact_manifold(first, pose1, second, pose2, find_proximity(first, pose1, second, pose2));
    CHECK(manifold.deepest.gap < 0);
    CHECK(manifold.corner_count == 0);
  }
}

TEST_CASE("bodies that are apart or only touch have no manifold points") {
  const Superellipsoid brick(Vector3(0.1, 0.07, 0.05), 20, 20);
  CHECK(manifold_on_floor(brick, Matrix3::Identity(), -1e-3).corner_count == 0);
  CHECK(manifold_on_floor(brick, Matrix3::Identity(), 0).corner_count == 0);
  CHECK(find_contact_manifold(brick, {}, brick, {}, Proximity{}).corner_count == 0);
}

TEST_CASE("a plate without thickness has one contact") {
  const Superellipsoid brick(Vector3(0.1, 0.07, 0.05), 20, 20);
  const Box plate(Vector3(2, 2, 0));
  const Pose pose{Vector3(0, 0, 0.0499), Matrix3::Identity()};
  const ContactManifold manifold = find_contact_manifold(brick, pose, plate, {}, find_proximity(brick, pose, plate, {}));
  CHECK(manifold.deepest.gap < 0);
  CHECK(manifold.corner_count == 0);
}

TEST_CASE("a flat body on a floor has four manifold points, close to the body") {
  test::Draw random(2);
  for (int repetition = 0; repetition < 500; ++repetition) {
    const Vector3 half_axes = random.within(0.5, 2);
    const Superellipsoid body(half_axes, random.uniform(8, 100), random.uniform(8, 100));
    const double depth = half_axes.z() * std::pow(10, random.uniform(-4, -2));
    Pose pose;
    const ContactManifold manifold =
        manifold_on_floor(body, tilt(random.uniform(0, 0.2) * depth / half_axes.maxCoeff(), random.uniform(0, 7)), depth, &pose);
    CHECK(manifold.deepest.gap == test::relative(-depth).epsilon(1e-9));
    REQUIRE(manifold.corner_count == 4);
    for (const ManifoldCorner& corner : manifold.corners) {
      CHECK(corner.depth >= 0);
      CHECK(corner.depth <= depth * (1 + 1e-9));
      // The ray starts below the body's deepest point and goes up.
      const Vector3 below = corner.point - 2 * (manifold.margin + depth) * Vector3::UnitZ();
      const RayHit hit = find_ray_hit(body, pose, below, Vector3::UnitZ(), 1);
      REQUIRE(hit.hit);
      CHECK(hit.point.z() <= manifold.margin * (1 + 1e-6));
      // The manifold point is in the tangent plane, and the body is not far above it.
      CHECK(corner.point.z() <= 0);
      CHECK(hit.point.z() - corner.point.z() <= manifold.margin + depth * (1 + 1e-6));
    }
    // The manifold points span most of the face.
    CHECK((manifold.corners[2].point - manifold.corners[0].point).norm() >= std::hypot(half_axes.x(), half_axes.y()));
    CHECK((manifold.corners[3].point - manifold.corners[1].point).norm() >= std::hypot(half_axes.x(), half_axes.y()));
  }
}

TEST_CASE("the manifold of a level brick on a plane takes eight boundary points") {
  for (const double exponent : {8.0, 20.0, 60.0, 200.0}) {
    const Superellipsoid brick({0.1, 0.07, 0.05}, exponent, exponent);
    CHECK(manifold_on_floor(brick, tilt(1e-6, 0.3), 1e-5).evaluations == 8);
  }
}

TEST_CASE("the deepest contact is as deep as the overlap at every max_contacts") {
  test::Draw random(6);
  for (int repetition = 0; repetition < 500; ++repetition) {
    const Vector3 half_axes = random.within(0.5, 2);
    const Superellipsoid body(half_axes, random.uniform(6, 100), random.uniform(6, 100));
    const double depth = half_axes.z() * std::pow(10, random.uniform(-5, -0.5));
    const Matrix3 leaning = tilt(random.uniform(0, 0.2), random.uniform(0, 7));
    const ContactManifold manifold = manifold_on_floor(body, leaning, depth);
    for (int room = 2; room <= 8; ++room) {
      CAPTURE(room);
      const ContactManifold reduced = reduced_to(manifold, room);
      if (reduced.corner_count == 0) continue;
      double deepest = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(reduced.corner_count); ++k) {
        deepest = std::max(deepest, reduced.corners[k].depth);
      }
      CHECK(deepest == test::relative(-manifold.deepest.gap).epsilon(1e-12));
      CHECK(reduced.corners[0].depth == test::relative(deepest).epsilon(1e-9));
    }
  }
}

TEST_CASE("a can has two manifold points on its side and four on its end") {
  const Superellipsoid can(Vector3(0.03, 0.03, 0.06), 2, 30);
  const ContactManifold upright = manifold_on_floor(can, Matrix3::Identity(), 1e-5);
  REQUIRE(upright.corner_count == 4);
  const ContactManifold lying = reduced_to(manifold_on_floor(can, tilt(0.5 * std::numbers::pi, 0), 1e-5), 8);
  REQUIRE(lying.corner_count == 2);
  const Vector3 between = lying.corners[1].point - lying.corners[0].point;
  CHECK(std::abs(between.y()) >= 0.1);
  // The manifold points are on the line on which it rolls.
  CHECK(std::abs(between.x()) <= 1e-12);
  CHECK(std::abs(lying.corners[0].point.x() - lying.deepest.contact.x()) <= 1e-12);
}

TEST_CASE("a can on its side has a manifold point at each end, with the depth there, at any depth and tilt") {
  constexpr double kRadius = 0.05;
  constexpr double kHalfLength = 0.25;
  const Superellipsoid can(Vector3(kRadius, kRadius, kHalfLength), 2, 60);
  for (const double depth : {1e-9, 1e-6, 1e-3, 0.01, 0.05, 0.2, 0.5, 1.0}) {
    for (const double lean : {0.0, 1e-3, 0.01, 0.05}) {
      CAPTURE(depth);
      CAPTURE(lean);
      const ContactManifold manifold =
          reduced_to(manifold_on_floor(can, tilt(0.5 * std::numbers::pi + lean, std::numbers::pi / 2), depth * kRadius), 8);
      const double depth_of_far_end = depth * kRadius - 2 * kHalfLength * std::sin(lean);
      if (depth_of_far_end < -1e-3 * kRadius) continue;  // this end is in the air
      REQUIRE(manifold.corner_count == 2);
      const Vector3 between = manifold.corners[1].point - manifold.corners[0].point;
      CHECK(between.norm() == test::relative(2 * kHalfLength).epsilon(0.08));
      CHECK(manifold.corners[0].depth == test::relative(depth * kRadius));
      CHECK(std::abs(manifold.corners[1].depth - std::max(0.0, depth_of_far_end)) <=
            0.06 * 2 * kHalfLength * std::sin(lean) + 1e-15);
    }
  }
}

TEST_CASE("the support polygon of a face does not shrink to a point as the depth goes to 0") {
  for (const double exponent : {6.0, 8.0, 20.0, 60.0, 1000.0}) {
    CAPTURE(exponent);
    const Superellipsoid brick(Vector3(0.1, 0.07, 0.05), exponent, exponent);
    const ContactManifold shallow = manifold_on_floor(brick, Matrix3::Identity(), 1e-12);
    for (const double depth : {1e-12, 1e-11, 1e-10, 1e-9, 1e-8}) {
      CAPTURE(depth);
      const ContactManifold manifold = manifold_on_floor(brick, Matrix3::Identity(), depth);
      REQUIRE(manifold.corner_count == 4);
      for (std::size_t k = 0; k < 4; ++k) {
        CHECK(manifold.corners[k].depth == test::relative(depth));
        const Vector3 moved = manifold.corners[k].point - shallow.corners[k].point;
        CHECK(std::hypot(moved.x(), moved.y()) <= 1e-3 * 0.1);
        CHECK(std::abs(manifold.corners[k].point.x() - 0.3) >= 0.4 * 0.1);
      }
    }
  }
}

TEST_CASE("a manifold point in the air moves in to where the tilted faces are close to each other") {
  const Superellipsoid brick(Vector3(0.1, 0.07, 0.05), 200, 200);
  const double depth = 1e-4;
  for (const double lean : {0.01, 0.02, 0.05}) {
    CAPTURE(lean);
    const ContactManifold manifold = reduced_to(manifold_on_floor(brick, tilt(lean, std::numbers::pi / 2), depth), 8);
    REQUIRE(manifold.corner_count == 4);
    CHECK(manifold.corners[0].depth == test::relative(depth));
    CHECK(manifold.corners[3].depth == 0);
    const double between = std::abs(manifold.corners[3].point.x() - manifold.corners[0].point.x());
    CHECK(between >= 0.95 * depth / lean);
    CHECK(between <= 1.05 * (depth + 0.035 * 0.05) / lean);
  }
}

TEST_CASE("a rounded body has the support polygon of the body without its rounding") {
  const Superellipsoid brick(Vector3(0.1, 0.07, 0.05), 60, 60);
  const Rounded rounded(std::make_shared<Superellipsoid>(brick), 0.04);
  const ContactManifold of_brick = manifold_on_floor(brick, Matrix3::Identity(), 1e-4);
  const ContactManifold of_rounded = manifold_on_floor(rounded, Matrix3::Identity(), 1e-4);
  REQUIRE(of_rounded.corner_count == 4);
  // The tilts are chosen for the whole body's half-extents.
  CHECK(distance_of_corners(of_brick, of_rounded) <= 2e-3);
}

TEST_CASE("a body has the same manifold points on a box and on a plane") {
  const Superellipsoid brick(Vector3(0.1, 0.07, 0.05), 12, 20);
  const Box table(Vector3(2, 2, 1));
  const Pose under{Vector3(0, 0, -1), Matrix3::Identity()};
  for (const double turn : {0.0, 0.3, 0.785398}) {
    const Matrix3 rotation = Eigen::AngleAxisd(turn, Vector3::UnitZ()).toRotationMatrix();
    Pose pose;
    ContactManifold on_plane = manifold_on_floor(brick, rotation, 1e-4, &pose);
    const ContactManifold on_box = find_contact_manifold(brick, pose, table, under, find_proximity(brick, pose, table, under));
    REQUIRE(on_plane.corner_count == 4);
    REQUIRE(on_box.corner_count == 4);
    // Manifold points on a plane are points of the body. The others are in the plane of the contact.
    for (ManifoldCorner& corner : on_plane.corners) corner.point.z() = on_box.corners[0].point.z();
    CHECK(distance_of_corners(on_plane, on_box) <= 1e-14);
  }
}

TEST_CASE("no manifold point is beyond the border of the lower body") {
  const Superellipsoid brick(Vector3(0.1, 0.07, 0.05), 20, 20);
  const ContactManifold manifold = manifold_of_stacked(brick, brick, 0.1, 0.0, 0, 1e-4);
  REQUIRE(manifold.corner_count == 4);
  for (const ManifoldCorner& corner : manifold.corners) {
    CHECK(corner.point.x() >= -1e-3);
    CHECK(corner.point.x() <= 0.1 + 1e-3);
    CHECK(std::abs(corner.point.y()) <= 0.07);
  }
  CHECK((manifold.corners[2].point - manifold.corners[0].point).norm() >= 0.8 * std::hypot(0.1, 0.14));
}

TEST_CASE("the deepest point of an overhanging face is on both bodies") {
  test::Draw random(5);
  // The gauge is 1 on the surface of a superellipsoid, and less inside.
  const auto gauge = [](const Superellipsoid& body, const Pose& pose, const Vector3& point) {
    const Vector3 local = (pose.rotation.transpose() * (point - pose.position)).cwiseQuotient(body.half_axes()).cwiseAbs();
    const double largest = local.maxCoeff();
    return largest * std::pow((local / largest).array().pow(body.delta()).sum(), 1 / body.delta());
  };
  for (int repetition = 0; repetition < 3000; ++repetition) {
    const auto brick = [&](double exponent) { return Superellipsoid(random.within(0.1, 1), exponent, exponent); };
    const Superellipsoid lower = brick(repetition % 2 == 0 ? 8 : 60);
    const Superellipsoid upper = brick(repetition % 3 == 0 ? 8 : 60);
    const Pose pose1{Vector3(random.uniform(-1, 1), 0, 0), random.rotation()};
    const double overlap = 1e-3 * lower.half_axes().z() * std::pow(10, random.uniform(-4, 0));
    const Vector3 beside{random.uniform(-1, 1) * lower.half_axes().x(), random.uniform(-1, 1) * lower.half_axes().y(),
                         lower.half_axes().z() + upper.half_axes().z() - overlap};
    const Matrix3 yaw = Eigen::AngleAxisd(random.uniform(0, 6), Vector3::UnitZ()).toRotationMatrix();
    const Pose pose2{pose1.position + pose1.rotation * beside, pose1.rotation * yaw};
    const Proximity proximity = find_proximity(lower, pose1, upper, pose2);
    if (proximity.gap >= 0) continue;
    const ContactManifold manifold = find_contact_manifold(lower, pose1, upper, pose2, proximity);
    for (const Vector3& contact : {proximity.contact, manifold.deepest.contact}) {
      CHECK(gauge(lower, pose1, contact) <= 1 + 1e-6);
      CHECK(gauge(upper, pose2, contact) <= 1 + 1e-6);
    }
  }
}

TEST_CASE("a capsule along a brick rests on its two ends, and a capsule across it on the brick's width") {
  const Superellipsoid brick(Vector3(0.1, 0.07, 0.05), 30, 30);
  const Capsule capsule(0.02, 0.06);
  Pose pose{Vector3(0, 0, 0.07 - 1e-5), Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitY()).toRotationMatrix()};
  const ContactManifold along =
      reduced_to(find_contact_manifold(brick, {}, capsule, pose, find_proximity(brick, {}, capsule, pose)), 8);
  REQUIRE(along.corner_count == 2);
  CHECK((along.corners[1].point - along.corners[0].point).norm() == test::relative(0.12).epsilon(1e-5));
}

TEST_CASE("the manifold points do not depend on the order of the bodies or on the frame") {
  test::Draw random(3);
  const Vector3 far(3e3, -4e3, 5e3);
  int wide = 0;
  for (int repetition = 0; repetition < 300; ++repetition) {
    const Superellipsoid lower(Vector3{random.uniform(0.5, 2), random.uniform(0.5, 2), 0.7}, random.uniform(6, 50),
                               random.uniform(6, 50));
    const Superellipsoid upper(Vector3{random.uniform(0.5, 2), random.uniform(0.5, 2), 0.4}, random.uniform(6, 50),
                               random.uniform(6, 50));
    const Pose pose1;
    const Pose pose2{Vector3{random.uniform(-1, 1), random.uniform(-1, 1), 1.1 - 1e-3},
                     Matrix3(Eigen::AngleAxisd(random.uniform(0, 6), Vector3::UnitZ()) * tilt(1e-4, random.uniform(0, 7)))};
    const Proximity proximity = find_proximity(lower, pose1, upper, pose2);
    const ContactManifold manifold = find_contact_manifold(lower, pose1, upper, pose2, proximity);
    wide += manifold.corner_count > 0 ? 1 : 0;

    Proximity swapped = proximity;
    swapped.normal = -swapped.normal;
    std::swap(swapped.point1, swapped.point2);
    const ContactManifold of_swapped = find_contact_manifold(upper, pose2, lower, pose1, swapped);
    CHECK(of_swapped.corner_count == manifold.corner_count);
    CHECK(distance_of_corners(manifold, of_swapped) <= 1e-13);

    const Matrix3 turn = random.rotation();
    const auto moved = [&](const Pose& pose) { return Pose{turn * pose.position + far, turn * pose.rotation}; };
    Proximity there = proximity;
    there.normal = turn * proximity.normal;
    for (Vector3* const point : {&there.point1, &there.point2, &there.contact}) *point = turn * *point + far;
    ContactManifold back = find_contact_manifold(lower, moved(pose1), upper, moved(pose2), there);
    for (ManifoldCorner& corner : back.corners) corner.point = turn.transpose() * (corner.point - far);
    CHECK(back.corner_count == manifold.corner_count);
    CHECK(distance_of_corners(manifold, back) <= 1e-9);
  }
  CHECK(wide > 200);
}
