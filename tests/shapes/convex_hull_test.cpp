// The hull of lattice points against its definition, and the face normals of remembered hulls.
#include "shapes/convex_hull.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "shapes/face_normals.hpp"

using namespace supernormal;

namespace {

struct Generator {
  std::mt19937_64 engine{5};
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(engine);
  }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  double gauss() { return std::normal_distribution<double>()(engine); }
  Vector3 direction() { return Vector3{gauss(), gauss(), gauss()}.normalized(); }
  Matrix3 rotation() {
    return Eigen::Quaterniond(Eigen::Vector4d{gauss(), gauss(), gauss(), gauss()}.normalized()).toRotationMatrix();
  }
};

std::int64_t height(const ConvexHull::Face& face, std::span<const LatticePoint> points, const LatticePoint& p) {
  std::int64_t sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += face.normal[axis] * (p[axis] - points[face.vertices[0]][axis]);
  return sum;
}

// Every point is behind every face, and every edge has its two faces: then the surface is closed and is that of the hull.
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

std::vector<Vector3> normals_of(const std::vector<LatticePoint>& points) {
  ConvexHull hull;
  hull.build(points);
  std::vector<Vector3> normals;
  hull.add_face_normals(normals);
  return normals;
}

// The smallest angle between a direction and one of the normals.
double angle_to_nearest(std::span<const Vector3> normals, const Vector3& direction) {
  double least = std::numbers::pi;
  for (const Vector3& n : normals) least = std::min(least, std::atan2(n.cross(direction).norm(), n.dot(direction)));
  return least;
}

std::vector<Vector3> box_corners(const Vector3& half) {
  std::vector<Vector3> corners;
  for (unsigned k = 0; k < 8; ++k) {
    corners.emplace_back((k & 1U) != 0 ? half.x() : -half.x(), (k & 2U) != 0 ? half.y() : -half.y(),
                         (k & 4U) != 0 ? half.z() : -half.z());
  }
  return corners;
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
  std::vector<LatticePoint> corners;
  for (const std::int64_t x : {-w, w}) {
    for (const std::int64_t y : {-w, w}) {
      for (const std::int64_t z : {-w, w}) corners.push_back({x, y, z});
    }
  }
  CHECK(hull_faces(corners) == 12);
  const auto normals = normals_of(corners);
  REQUIRE(normals.size() == 6);
  for (const Vector3& n : normals) CHECK(n.cwiseAbs().maxCoeff() == 1);
}

TEST_CASE("points on a sphere are all corners: 2n - 4 triangles") {
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
  CHECK(hull_faces({{0, 0, 0}, {3, 6, 9}, {1, 2, 3}, {2, 4, 6}}) == 0);  // on a line
  const std::vector<LatticePoint> flat = {{0, 0, 700}, {900, 0, 700}, {0, 900, 700}, {900, 900, 700}, {400, 500, 700}};
  CHECK(hull_faces(flat) == 2);
  const auto normals = normals_of(flat);
  REQUIRE(normals.size() == 2);
  CHECK(normals[0] == -normals[1]);
  CHECK(std::abs(normals[0].z()) == 1);
}

TEST_CASE("face normals of boxes and prisms, turned and moved, are those of their faces and no others") {
  Generator g;
  FaceNormals face_normals;
  for (int repetition = 0; repetition < 300; ++repetition) {
    CAPTURE(repetition);
    const Matrix3 R = g.rotation();
    std::vector<Vector3> points;
    std::vector<Vector3> expected;
    const Vector3 half{g.uniform(0.2, 1), g.uniform(0.2, 1), g.uniform(0.2, 1)};
    if (repetition % 2 == 0) {
      points = box_corners(half);
      for (const double sign : {-1.0, 1.0}) {
        for (int axis = 0; axis < 3; ++axis) expected.emplace_back(sign * Vector3::Unit(axis));
      }
    } else {
      constexpr int kSides = 12;
      for (int k = 0; k < kSides; ++k) {
        const double angle = 2 * std::numbers::pi * k / kSides;
        const double middle = angle + std::numbers::pi / kSides;
        for (const double z : {-half.z(), half.z()}) points.emplace_back(half.x() * std::cos(angle), half.x() * std::sin(angle), z);
        expected.emplace_back(std::cos(middle), std::sin(middle), 0);
      }
      expected.emplace_back(Vector3::UnitZ());
      expected.emplace_back(-Vector3::UnitZ());
    }
    for (Vector3& p : points) p = R * p;
    const auto found = face_normals.find(points);
    CHECK(found.size() == expected.size());
    for (const Vector3& n : expected) CHECK(angle_to_nearest(found, R * n) < 1e-4);
  }
}

TEST_CASE("remembered normals do not depend on order, rounding or history") {
  Generator g;
  std::vector<std::vector<Vector3>> hulls;
  for (int k = 0; k < 60; ++k) {
    // Binary fractions, as coordinates read from a file of floats: halfway between places of a lattice more often than by chance.
    hulls.emplace_back();
    for (int i = 0; i < 12; ++i) hulls.back().push_back(Vector3{g.gauss(), g.gauss(), g.gauss()}.cast<float>().cast<double>());
  }
  FaceNormals kept;
  for (int repetition = 0; repetition < 600; ++repetition) {
    std::vector<Vector3> points = hulls[static_cast<std::size_t>(g.integer(0, 59))];
    FaceNormals fresh;
    const auto expected = fresh.find(points);
    std::shuffle(points.begin(), points.end(), g.engine);
    for (Vector3& p : points) p *= 1 + 1e-15 * g.gauss();
    const auto found = kept.find(points);
    REQUIRE(found.size() == expected.size());
    CHECK(std::equal(found.begin(), found.end(), expected.begin()));
  }
}

TEST_CASE("more hulls than are remembered, and hulls of all sizes") {
  Generator g;
  FaceNormals face_normals;
  for (int repetition = 0; repetition < 3000; ++repetition) {
    const double size = std::pow(10.0, 40 * (repetition % 15) - 300);
    auto points = box_corners({1, 2, 3 + 0.001 * repetition});
    for (Vector3& p : points) p *= size;
    CHECK(face_normals.find(points).size() == (size > 1e-290 ? 6 : 0));
  }
}
