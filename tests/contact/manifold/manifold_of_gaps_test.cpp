// Tests of the manifold of bodies that are apart, with the gap of each manifold point, and of convex polygons in the plane of a
// contact.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>

#include "contact/manifold/convex_polygon.hpp"
#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/relative.hpp"

using namespace supernormal;

namespace {

const Superellipsoid kBrick({0.1, 0.07, 0.05}, 60, 60);

Matrix3 turned(double angle, const Vector3& axis) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

constexpr double kApproach = 1e-3;  // m; the overlap that would form in the step

/// The contacts of a body that is `gap` above the plane z = 0.
ContactManifold above_floor(const Shape& shape, const Matrix3& rotation, double gap, double approach = kApproach) {
  Pose pose{Vector3(0.3, -0.2, 0), rotation};
  pose.position.z() = gap - find_plane_proximity(shape, pose, Vector3::UnitZ(), 0).gap;
  const Proximity proximity = find_plane_proximity(shape, pose, Vector3::UnitZ(), 0);
  return reduced_to(find_plane_manifold_of_gaps(shape, pose, proximity, approach), 8);
}

ConvexPolygon polygon(std::initializer_list<Vector2> corners) {
  ConvexPolygon result;
  for (const Vector2& corner : corners) result.add(corner);
  return result;
}

ConvexPolygon regular(int corners, double radius, const Vector2& centre, double turn) {
  ConvexPolygon result;
  for (int k = 0; k < corners; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / corners;
    result.add(centre + radius * Vector2(std::cos(angle), std::sin(angle)));
  }
  return result;
}

double area(const ConvexPolygon& polygon) {
  double twice = 0;
  for (int k = 0; k < polygon.size(); ++k) {
    const Vector2& a = polygon[k];
    const Vector2& b = polygon[(k + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double distance_outside(const ConvexPolygon& polygon, const Vector2& point) {
  double outside = 0;
  for (int k = 0; k < polygon.size(); ++k) {
    const Vector2 edge = polygon[(k + 1) % polygon.size()] - polygon[k];
    if (edge.norm() == 0) continue;
    const Vector2 to_point = point - polygon[k];
    outside = std::fmax(outside, (edge.y() * to_point.x() - edge.x() * to_point.y()) / edge.norm());
  }
  return outside;
}

}  // namespace

TEST_CASE("a level brick above a floor has four manifold points with the gap of the brick") {
  for (const double gap : {0.1, 1e-3, 0.0, -1e-4}) {
    const ContactManifold manifold = above_floor(kBrick, Matrix3::Identity(), gap);
    REQUIRE(manifold.corner_count == 4);
    for (int k = 0; k < 4; ++k) {
      const ManifoldCorner& corner = manifold.corners[static_cast<std::size_t>(k)];
      CHECK(corner.depth == doctest::Approx(-gap).epsilon(1e-9));
      CHECK(std::abs(corner.point.x() - 0.3) == doctest::Approx(0.1).epsilon(0.1));
      CHECK(std::abs(corner.point.y() + 0.2) == doctest::Approx(0.07).epsilon(0.1));
    }
  }
}

TEST_CASE("the manifold points of a tilted face have the gap that is left there, the smallest first") {
  for (const double angle : {0.001, 0.01, 0.05}) {
    const ContactManifold manifold = above_floor(kBrick, turned(angle, Vector3::UnitY()), 1e-3);
    REQUIRE(manifold.corner_count == 4);
    CHECK(manifold.corners[0].depth == doctest::Approx(-1e-3));
    CHECK(manifold.corners[1].depth == doctest::Approx(-1e-3));
    for (const std::size_t far : {2U, 3U}) {
      const double length = std::abs(manifold.corners[far].point.x() - manifold.corners[0].point.x());
      CHECK(length > 0.18);
      CHECK(-manifold.corners[far].depth == doctest::Approx(1e-3 + length * std::tan(angle)).epsilon(0.01));
    }
  }
}

TEST_CASE("round bodies have one contact ahead, a can on its side two, a standing can four") {
  const Ellipsoid ball(Vector3(0.05, 0.05, 0.05));
  const Superellipsoid round({0.1, 0.07, 0.05}, 4, 4);
  const Superellipsoid can({0.05, 0.05, 0.2}, 2, 60);
  const Matrix3 on_side = turned(std::numbers::pi / 2, Vector3(1, 0.3, 0));
  for (const double gap : {0.02, 1e-5, -1e-5}) {
    CHECK(above_floor(ball, Matrix3::Identity(), gap).corner_count == 0);
    CHECK(above_floor(round, Matrix3::Identity(), gap).corner_count == 0);
    CHECK(above_floor(can, on_side, gap).corner_count == 2);
    CHECK(above_floor(can, Matrix3::Identity(), gap).corner_count == 4);
  }
}

TEST_CASE("manifold points do not move when the gap passes through 0") {
  for (const double angle : {0.0, 0.03}) {
    for (const double approach : {0.0, kApproach}) {
      const Matrix3 rotation = turned(angle, Vector3(1, 2, 0));
      const ContactManifold before = above_floor(kBrick, rotation, 1e-12, approach);
      const ContactManifold after = above_floor(kBrick, rotation, -1e-12, approach);
      REQUIRE(before.corner_count == after.corner_count);
      for (int k = 0; k < before.corner_count; ++k) {
        const auto index = static_cast<std::size_t>(k);
        CHECK((before.corners[index].point - after.corners[index].point).norm() < 1e-8);
        CHECK(std::abs(before.corners[index].depth - after.corners[index].depth) < 1e-8);
      }
    }
  }
}

TEST_CASE("a body that rests has the manifold points of an overlap, and one that lands has them farther out") {
  for (const double exponent : {6.0, 8.0, 20.0, 60.0}) {
    const Superellipsoid body({0.1, 0.07, 0.05}, exponent, exponent);
    const Pose pose{Vector3(0.3, -0.2, 0.05 - 1e-6), Matrix3::Identity()};
    const Proximity proximity = find_plane_proximity(body, pose, Vector3::UnitZ(), 0);
    const ContactManifold of_overlap = find_plane_contact_manifold(body, pose, proximity);
    const ContactManifold of_gaps = find_plane_manifold_of_gaps(body, pose, proximity);
    const ContactManifold landing = find_plane_manifold_of_gaps(body, pose, proximity, kApproach);
    REQUIRE(of_overlap.corner_count == 4);
    REQUIRE(of_gaps.corner_count == 4);
    REQUIRE(landing.corner_count == 4);
    for (std::size_t k = 0; k < 4; ++k) {
      // On the body: under the points in the plane, beside which is the small ball that rolls in the body.
      const Vector3 up = of_gaps.corners[k].point - of_overlap.corners[k].point;
      CHECK(up.head<2>().norm() < 3e-3 * 0.05);
      CHECK(up.z() >= 0);
      CHECK(up.z() < 3e-3 * 0.05);
      CHECK(of_gaps.corners[k].depth == of_overlap.corners[k].depth);
      CHECK(landing.corners[k].depth == doctest::Approx(1e-6));
      CHECK((landing.corners[k].point - pose.position).norm() > 1.01 * (of_gaps.corners[k].point - pose.position).norm());
    }
  }
}

TEST_CASE("two bodies have manifold points on the intersection of their faces, placed by `share`, also when swapped") {
  const Box table(Vector3(0.5, 0.5, 0.1));
  const Pose pose1;
  const Pose pose2{Vector3(0.45, 0, 0.17), Matrix3::Identity()};  // it overhangs by half of its length; gap 0.02
  const Proximity proximity = find_proximity(table, pose1, kBrick, pose2);
  REQUIRE(proximity.gap == doctest::Approx(0.02));
  for (const double share : {0.0, 0.5, 1.0}) {
    const ContactManifold manifold = reduced_to(find_manifold_of_gaps(table, pose1, kBrick, pose2, proximity, share, kApproach), 8);
    REQUIRE(manifold.corner_count == 4);
    double right = 0;
    for (const ManifoldCorner& corner : manifold.corners) {
      CHECK(corner.depth == doctest::Approx(-0.02));
      if (share == 0) {
        const double off = find_proximity(kBrick, pose2, Sphere(0), {corner.point, Matrix3::Identity()}).gap;
        CHECK(std::abs(off) < 1e-9);
      } else {
        CHECK(corner.point.z() == doctest::Approx(0.12 - share * 0.02));
      }
      right = std::max(right, corner.point.x());
    }
    CHECK(right == doctest::Approx(0.5));  // the border of the table
    const Proximity other = find_proximity(kBrick, pose2, table, pose1);
    const ContactManifold swapped = reduced_to(find_manifold_of_gaps(kBrick, pose2, table, pose1, other, 1 - share, kApproach), 8);
    REQUIRE(swapped.corner_count == 4);
    for (const ManifoldCorner& corner : manifold.corners) {
      const bool has_it = std::any_of(swapped.corners.begin(), swapped.corners.end(), [&](const ManifoldCorner& twin) {
        return (twin.point - corner.point).norm() < 1e-6 && std::abs(twin.depth - corner.depth) < 1e-9;
      });
      CHECK(has_it);
    }
  }
}

TEST_CASE("with a smaller max_contacts the nearest manifold point keeps its gap") {
  const ContactManifold all = above_floor(kBrick, turned(0.02, Vector3(1, 2, 0)), 1e-3);
  REQUIRE(all.corner_count == 4);
  Pose pose{Vector3(0, 0, 0), turned(0.02, Vector3(1, 2, 0))};
  pose.position.z() = 1e-3 - find_plane_proximity(kBrick, pose, Vector3::UnitZ(), 0).gap;
  const Proximity proximity = find_plane_proximity(kBrick, pose, Vector3::UnitZ(), 0);
  const ContactManifold manifold = find_plane_manifold_of_gaps(kBrick, pose, proximity, kApproach);
  for (int room = 1; room <= 5; ++room) {
    const ContactManifold reduced = reduced_to(manifold, room);
    CHECK(reduced.corner_count == (room < 3 ? 0 : std::min(room, 4)));  // two support only a line
    CHECK(reduced.deepest.gap == doctest::Approx(1e-3));
    for (int k = 0; k < reduced.corner_count; ++k) {
      const double depth = reduced.corners[static_cast<std::size_t>(k)].depth;
      CHECK(depth <= -1e-3 + 1e-12);
      if (k > 0) CHECK(depth <= reduced.corners[static_cast<std::size_t>(k - 1)].depth + 1e-12);
    }
  }
}

TEST_CASE("with max_contacts 3 a tilted brick is supported around its centre, whichever manifold point is the nearest") {
  for (int k = 0; k < 36; ++k) {
    const double direction = (5 + 10 * k) * std::numbers::pi / 180;
    Pose pose{Vector3::Zero(), turned(0.05, Vector3(std::cos(direction), std::sin(direction), 0))};
    pose.position.z() = 1e-3 - find_plane_proximity(kBrick, pose, Vector3::UnitZ(), 0).gap;
    const Proximity proximity = find_plane_proximity(kBrick, pose, Vector3::UnitZ(), 0);
    const ContactManifold three = reduced_to(find_plane_manifold_of_gaps(kBrick, pose, proximity, kApproach), 3);
    REQUIRE(three.corner_count == 3);
    // The parts of a weight at the centre that the three points bear.
    Matrix3 corners;
    for (int corner = 0; corner < 3; ++corner) {
      const Vector3& point = three.corners[static_cast<std::size_t>(corner)].point;
      corners.col(corner) = Vector3(point.x(), point.y(), 1);
    }
    const Vector3 parts = corners.inverse() * Vector3(0, 0, 1);
    CAPTURE(direction);
    CHECK(parts.minCoeff() > 0.1);
  }
}

TEST_CASE("two squares intersect in a rectangle") {
  const ConvexPolygon square = polygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  const ConvexPolygon shifted = polygon({{1, 0.5}, {3, 0.5}, {3, 2.5}, {1, 2.5}});
  const ConvexPolygon common = square.intersected(shifted);
  CHECK(area(common) == test::relative(1.5));
  CHECK(square.intersected(polygon({{5, 0}, {6, 0}, {6, 1}})).size() == 0);
}

TEST_CASE("a repeated vertex of a polygon changes nothing") {
  const ConvexPolygon square = polygon({{0, 0}, {0, 0}, {2, 0}, {2, 2}, {2, 2}, {0, 2}});
  CHECK(area(square.intersected(square)) == test::relative(4));
}

TEST_CASE("the intersection of random polygons is in both, in either order") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  std::uniform_int_distribution<int> corners(3, 4);
  for (int repetition = 0; repetition < 2000; ++repetition) {
    const ConvexPolygon first = regular(corners(random), 1, {place(random), place(random)}, place(random));
    const ConvexPolygon second = regular(corners(random), 0.7, {place(random), place(random)}, place(random));
    const ConvexPolygon common = first.intersected(second);
    const ConvexPolygon swapped = second.intersected(first);
    for (int k = 0; k < common.size(); ++k) {
      REQUIRE(distance_outside(first, common[k]) <= 1e-12);
      REQUIRE(distance_outside(second, common[k]) <= 1e-12);
    }
    REQUIRE(std::abs(area(common) - area(swapped)) <= 1e-12);
    // A point in both polygons is in their intersection.
    for (int k = 0; k < 20; ++k) {
      const Vector2 point{place(random), place(random)};
      if (distance_outside(first, point) > 0 || distance_outside(second, point) > 0) continue;
      REQUIRE(common.size() >= 3);
      REQUIRE(distance_outside(common, point) <= 1e-12);
    }
  }
}

TEST_CASE("the nearest point of a polygon is on its boundary, and no other point is nearer") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-4, 4);
  std::uniform_int_distribution<int> corners(1, 8);
  for (int repetition = 0; repetition < 1000; ++repetition) {
    const ConvexPolygon shape = regular(corners(random), 1, {0, 0}, place(random));
    const Vector2 point = (1.1 + std::abs(place(random))) * Vector2(std::cos(repetition), std::sin(repetition));
    const Vector2 nearest = shape.nearest_to(point);
    CHECK(distance_outside(shape, nearest) <= 1e-12);
    // The line across the segment to the nearest point separates the polygon from the point.
    const Vector2 way = point - nearest;
    for (int k = 0; k < shape.size(); ++k) CHECK(way.dot(shape[k] - nearest) <= 1e-12 * way.norm());
  }
}

TEST_CASE("the nearest point of a polygon moves no farther than the point outside") {
  const ConvexPolygon square = polygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  Vector2 previous = square.nearest_to({9, 1});
  for (int step = 1; step <= 1000; ++step) {
    const double angle = 0.002 * step;
    const Vector2 nearest = square.nearest_to({9 * std::cos(angle), 1 + 9 * std::sin(angle)});
    CHECK((nearest - previous).norm() <= 9 * 0.002 * (1 + 1e-12));
    previous = nearest;
  }
}
