// Tests of the hull around the origin against the definition of a convex hull.
#include "proximity/bounds/inner_polytope.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "proximity/bounds/minimum_norm_point.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// The distance of the origin from the planes through three of the points that have all others on the origin's side.
double inner_radius_of(const std::vector<Vector3>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        Vector3 normal = (points[j] - points[i]).cross(points[k] - points[i]);
        if (!(normal.norm() > 0)) continue;
        normal.normalize();
        if (normal.dot(points[i]) < 0) normal = -normal;
        const double height = normal.dot(points[i]);
        const bool is_facet =
            std::all_of(points.begin(), points.end(), [&](const Vector3& point) { return normal.dot(point) <= height + 1e-12; });
        if (is_facet) least = std::min(least, height);
      }
    }
  }
  return least;
}

InnerPolytope hull_of(const std::vector<Vector3>& points) {
  const auto tetrahedron = enclosing_tetrahedron(points);
  REQUIRE(tetrahedron.has_value());
  InnerPolytope hull;
  REQUIRE(hull.start(*tetrahedron));
  for (const Vector3& point : points) hull.add(point);
  return hull;
}

}  // namespace

TEST_CASE("the hull of random points contains the ball that the definition gives") {
  for (int seed = 1; seed <= 20; ++seed) {
    std::vector<Vector3> points = random_normals(24, seed);
    for (std::size_t k = 0; k < points.size(); ++k) {
      points[k] = points[k].cwiseProduct(Vector3(3, 2, 1)) * (k % 3 == 0 ? 0.8 : 1) + Vector3(0.2, 0.1, -0.1);
    }
    InnerPolytope hull = hull_of(points);
    CHECK(hull.inner_radius() == relative(inner_radius_of(points)).epsilon(1e-12));
    const InnerPolytope::Nearest nearest = hull.nearest();
    for (const Vector3& point : points) CHECK(nearest.normal.dot(point) <= nearest.distance + 1e-12);
  }
}

TEST_CASE("points on the faces and edges of a cube, many of them twice, make the cube") {
  std::vector<Vector3> points;
  for (int repetition = 0; repetition < 2; ++repetition) {
    for (int x = -2; x <= 2; ++x) {
      for (int y = -2; y <= 2; ++y) {
        for (int z = -2; z <= 2; ++z) {
          if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == 2) points.emplace_back(x, y + 0.25, z - 0.125);
        }
      }
    }
  }
  InnerPolytope hull = hull_of(points);
  CHECK(hull.inner_radius() == relative(1.75).epsilon(1e-14));
  CHECK_FALSE(hull.add(Vector3(1.9, 0.1, 0.3)));
  CHECK(hull.add(Vector3(2.5, 0.1, 0.3)));
}

TEST_CASE("no surface starts from a tetrahedron without the origin inside, nor from one that is flat") {
  InnerPolytope hull;
  CHECK(hull.start({Vector3(1, 1, 1), Vector3(1, -1, -1), Vector3(-1, 1, -1), Vector3(-1, -1, 1)}));
  CHECK_FALSE(hull.start({Vector3(4, 1, 1), Vector3(4, -1, -1), Vector3(2, 1, -1), Vector3(2, -1, 1)}));
  CHECK_FALSE(hull.start({Vector3(1, 0, 0), Vector3(-1, 1, 0), Vector3(-1, -1, 0), Vector3(0, 0, 0)}));
  CHECK_FALSE(hull.start({Vector3(1, 0, 0), Vector3(-1, 1, 0), Vector3(-1, -1, 0), Vector3(0.1, 0.1, 0)}));
}

TEST_CASE("a facet that was given up still bounds the radius, but is not the nearest any more") {
  const std::vector<Vector3> points = {{1, 1, 1}, {1, -1, -1}, {-2, 2, -2}, {-3, -3, 3}};
  InnerPolytope hull = hull_of(points);
  const double radius = hull.inner_radius();
  const InnerPolytope::Nearest nearest = hull.nearest();
  CHECK(nearest.distance == radius);
  hull.give_up(nearest);
  CHECK(hull.nearest().distance > radius);
  CHECK(hull.inner_radius() == radius);
}

TEST_CASE("offered points make the hull reach the goal as added ones do, and their mirror images too") {
  for (int seed = 1; seed <= 20; ++seed) {
    const Vector3 centre(0.2, 0.1, -0.1);
    std::vector<Vector3> points = random_normals(24, seed);
    for (Vector3& point : points) point = point.cwiseProduct(Vector3(3, 2, 1)) + centre;
    const auto tetrahedron = enclosing_tetrahedron(points);
    REQUIRE(tetrahedron.has_value());
    std::vector<Vector3> all = points;
    for (const bool is_symmetric : {false, true}) {
      if (is_symmetric) {
        for (const Vector3& point : points) all.emplace_back(2 * centre - point);
      }
      const double radius = inner_radius_of(all);
      for (const double share : {1.0, 0.5}) {
        InnerPolytope hull;
        REQUIRE(hull.start(*tetrahedron));
        hull.set_goal(share * radius);
        if (is_symmetric) hull.set_symmetry(centre);
        for (const Vector3& point : points) hull.offer(point);
        CHECK(hull.inner_radius() <= radius * (1 + 1e-12));  // before nearest() has taken the offers
        CHECK(hull.inner_radius() >= share * radius * (1 - 1e-12));
        CHECK(hull.nearest().distance >= share * radius * (1 - 1e-12));
      }
    }
  }
}

TEST_CASE("facets beyond the goal bound the radius, but are not the nearest") {
  InnerPolytope hull;
  REQUIRE(hull.start({Vector3(1, 1, 1), Vector3(1, -1, -1), Vector3(-1, 1, -1), Vector3(-1, -1, 1)}));
  const double radius = hull.inner_radius();
  hull.set_goal(1.5 * radius);
  for (const double x : {-3.0, 3.0}) {
    for (const double y : {-3.0, 3.0}) {
      for (const double z : {-3.0, 3.0}) hull.add(Vector3(x, y, z));
    }
  }
  CHECK(hull.nearest().distance == std::numeric_limits<double>::infinity());
  CHECK(hull.inner_radius() >= 1.5 * radius);
  CHECK(hull.inner_radius() <= 3 * (1 + 1e-12));
  hull.offer(Vector3(9, 9, 9));
  CHECK(hull.nearest().distance == std::numeric_limits<double>::infinity());
}
