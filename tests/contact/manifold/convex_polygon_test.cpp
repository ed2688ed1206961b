// Convex polygons in the plane of a contact.
#include "contact/manifold/convex_polygon.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>

#include "support/relative.hpp"

using namespace supernormal;

namespace {

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
