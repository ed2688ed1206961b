// Tests of the hull of lattice points against its definition.
#include "shapes/convex_hull.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>

using namespace supernormal;

namespace {

struct Generator {
  std::mt19937_64 engine{5};
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(engine);
  }
  double gauss() { return std::normal_distribution<double>()(engine); }
  Vector3 direction() { return Vector3{gauss(), gauss(), gauss()}.normalized(); }
};

std::int64_t height(const ConvexHull::Face& face, std::span<const LatticePoint> points, const LatticePoint& p) {
  std::int64_t sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += face.normal[axis] * (p[axis] - points[face.vertices[0]][axis]);
  return sum;
}

// Checks that every point is behind every face, and that every edge has its two faces: then the surface is closed and is that of
// the hull.
int check_hull(const ConvexHull& hull) {
  int faces = 0;
  std::set<std::pair<std::size_t, std::size_t>> edges;
  hull.for_each_face([&](const ConvexHull::Face& face) {
    ++faces;
    REQUIRE(face.normal != LatticePoint{0, 0, 0});
    for (const LatticePoint& p : hull.points()) REQUIRE(height(face, hull.points(), p) <= 0);
    for (std::size_t k = 0; k < 3; ++k) REQUIRE(edges.insert({face.vertices[k], face.vertices[(k + 1) % 3]}).second);
  });
  for (const auto& [from, to] : edges) REQUIRE(edges.contains({to, from}));
  return faces;
}

int hull_faces(const std::vector<LatticePoint>& points) {
  ConvexHull hull;
  hull.build(points);
  return check_hull(hull);
}

}  // namespace

TEST_CASE("random points, few places and many: all behind all faces, closed") {
  Generator g;
  for (int repetition = 0; repetition < 2000; ++repetition) {
    CAPTURE(repetition);
    // With few places most points are coplanar with others, collinear or repeated.
    const std::int64_t reach = std::array<std::int64_t, 4>{1, 2, 5, kLatticeHalfWidth}[static_cast<std::size_t>(repetition % 4)];
    std::vector<LatticePoint> points(static_cast<std::size_t>(g.integer(0, 60)));
    for (LatticePoint& p : points) p = {g.integer(-reach, reach), g.integer(-reach, reach), g.integer(-reach, reach)};
    hull_faces(points);
  }
}

TEST_CASE("the outermost places of the lattice do not overflow") {
  const std::int64_t w = kLatticeHalfWidth;
  std::vector<LatticePoint> vertices;
  for (const std::int64_t x : {-w, w}) {
    for (const std::int64_t y : {-w, w}) {
      for (const std::int64_t z : {-w, w}) vertices.push_back({x, y, z});
    }
  }
  CHECK(hull_faces(vertices) == 12);
}

TEST_CASE("points on a sphere are all vertices: 2n - 4 triangles") {
  Generator g;
  std::vector<LatticePoint> points;
  for (int k = 0; k < 500; ++k) {
    const Vector3 p = 0.999 * static_cast<double>(kLatticeHalfWidth) * g.direction();
    points.push_back({std::llround(p.x()), std::llround(p.y()), std::llround(p.z())});
  }
  CHECK(hull_faces(points) == 2 * 500 - 4);
}

TEST_CASE("what has no volume") {
  CHECK(hull_faces({}) == 0);
  CHECK(hull_faces({{1, 2, 3}, {1, 2, 3}}) == 0);
  CHECK(hull_faces({{0, 0, 0}, {3, 6, 9}, {1, 2, 3}, {2, 4, 6}}) == 0);  // the points are on a line
  const std::vector<LatticePoint> flat = {{0, 0, 700}, {900, 0, 700}, {0, 900, 700}, {900, 900, 700}, {400, 500, 700}};
  CHECK(hull_faces(flat) == 2);
}
