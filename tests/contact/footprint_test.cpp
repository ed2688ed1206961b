// Convex polygons in the plane of a contact.
#include "contact/footprint.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>

#include "relative.hpp"

using namespace supernormal;

namespace {

Footprint polygon(std::initializer_list<Vector2> corners) {
  Footprint result;
  for (const Vector2& corner : corners) result.add(corner);
  return result;
}

Footprint regular(int corners, double radius, const Vector2& centre, double turn) {
  Footprint result;
  for (int k = 0; k < corners; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / corners;
    result.add(centre + radius * Vector2(std::cos(angle), std::sin(angle)));
  }
  return result;
}

double area(const Footprint& polygon) {
  double twice = 0;
  for (int k = 0; k < polygon.size(); ++k) {
    const Vector2& a = polygon[k];
    const Vector2& b = polygon[(k + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double distance_outside(const Footprint& polygon, const Vector2& point) {
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

TEST_CASE("two squares have a rectangle in common") {
  const Footprint square = polygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  const Footprint shifted = polygon({{1, 0.5}, {3, 0.5}, {3, 2.5}, {1, 2.5}});
  const Footprint common = square.intersected(shifted);
  CHECK(area(common) == test::relative(1.5));
  CHECK(common.range(Vector2::UnitX()).width() == 1);
  CHECK(common.range(Vector2::UnitY()).width() == 1.5);
  CHECK(square.intersected(polygon({{5, 0}, {6, 0}, {6, 1}})).size() == 0);
}

TEST_CASE("a repeated corner does no harm") {
  const Footprint square = polygon({{0, 0}, {0, 0}, {2, 0}, {2, 2}, {2, 2}, {0, 2}});
  CHECK(area(square.intersected(square)) == test::relative(4));
}

TEST_CASE("what random polygons have in common is in both, in either order") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  std::uniform_int_distribution<int> corners(3, 8);
  for (int repetition = 0; repetition < 2000; ++repetition) {
    const Footprint first = regular(corners(random), 1, {place(random), place(random)}, place(random));
    const Footprint second = regular(corners(random), 0.7, {place(random), place(random)}, place(random));
    const Footprint common = first.intersected(second);
    const Footprint swapped = second.intersected(first);
    for (int k = 0; k < common.size(); ++k) {
      REQUIRE(distance_outside(first, common[k]) <= 1e-12);
      REQUIRE(distance_outside(second, common[k]) <= 1e-12);
    }
    REQUIRE(std::abs(area(common) - area(swapped)) <= 1e-12);
    // A point in both is in what they have in common.
    for (int k = 0; k < 20; ++k) {
      const Vector2 point{place(random), place(random)};
      if (distance_outside(first, point) > 0 || distance_outside(second, point) > 0) continue;
      REQUIRE(common.size() >= 3);
      REQUIRE(distance_outside(common, point) <= 1e-12);
    }
  }
}

TEST_CASE("the quadrangle of a rectangle is the rectangle") {
  const Footprint rectangle = polygon({{0, 0}, {1.5, 0}, {3, 0}, {3, 1}, {1, 1}, {0, 1}});
  const Footprint corners = rectangle.quadrangle();
  REQUIRE(corners.size() == 4);
  CHECK((corners[1] - corners[0]).norm() == test::relative(std::sqrt(10.0)));
  for (int k = 0; k < 4; ++k) {
    CHECK((corners[k].x() == 0 || corners[k].x() == 3));
    CHECK((corners[k].y() == 0 || corners[k].y() == 1));
  }
}

TEST_CASE("a triangle has three corners, a segment two") {
  CHECK(polygon({{0, 0}, {2, 0}, {0, 1}}).quadrangle().size() == 3);
  CHECK(polygon({{0, 0}, {2, 0}}).quadrangle().size() == 2);
  CHECK(Footprint().quadrangle().size() == 0);
}
