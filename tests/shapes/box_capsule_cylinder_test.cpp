// Tests of the bodies of ODE as shapes: support and points against brute force, vertices, mass by independent methods.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// Checks h, r and the vertices against points that cover the boundary, the farthest of which is within `grain` of the true
/// maximum.
void check_against(const Shape& shape, const std::vector<Vector3>& boundary, const std::vector<Vector3>& normals, double grain) {
  const double size = shape.half_extents().norm();
  for (const Vector3& n : normals) {
    const Jet jet = shape.jet(n);
    double farthest = -1e300;
    for (const Vector3& point : boundary) farthest = std::max(farthest, n.dot(point));
    const bool right = farthest <= jet.h + 4e-15 * size && farthest >= jet.h - grain * size;
    const bool on_plane = std::abs(n.dot(jet.r) - jet.h) <= 4e-15 * size;
    const double rounding = 4e-15 * (size + jet.H.norm());
    const bool kernel = (jet.H * n).norm() <= rounding && (jet.H - jet.H.transpose()).norm() <= rounding;
    if (!(right && on_plane && kernel)) FAIL_CHECK("n ", text(n), " h ", jet.h, " farthest ", farthest, " n.r ", n.dot(jet.r));
    for (const Vector3& m : normals) {
      if (!(m.dot(jet.r) <= shape.support(m) + 4e-15 * size)) FAIL_CHECK("r is not a point of the body: n ", text(n));
    }
    ActiveVertices vertices;
    shape.add_active_vertices(n, Vector3(0.3, -0.2, 0.1), vertices);
    double highest = -1e300;
    for (int k = 0; k < vertices.size(); ++k) highest = std::max(highest, n.dot(vertices[k]));
    if (shape.traits().has_nonsmooth_points && !(std::abs(highest - jet.h) <= 4e-15 * size))
      FAIL_CHECK("no vertex is at h: n ", text(n));
  }
}

std::vector<Vector3> normals_of_test(unsigned seed) {
  std::vector<Vector3> normals = all_normals(100, seed);
  // A hundred normals suffice for comparisons of each with each.
  std::vector<Vector3> few;
  for (std::size_t i = 0; i < normals.size(); i += 9) few.push_back(normals[i]);
  return few;
}

std::vector<Vector3> box_corners(const Vector3& half) {
  std::vector<Vector3> points;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) points.emplace_back(half.cwiseProduct(Vector3(x, y, z)));
    }
  }
  return points;
}

std::vector<Vector3> circle(double radius, double z) {
  std::vector<Vector3> points;
  points.reserve(360);
  for (int i = 0; i < 360; ++i)
    points.emplace_back(radius * std::cos(i * std::numbers::pi / 180), radius * std::sin(i * std::numbers::pi / 180), z);
  return points;
}

std::vector<Vector3> cylinder_points(double radius, double half_length) {
  std::vector<Vector3> points = circle(radius, half_length);
  const std::vector<Vector3> bottom = circle(radius, -half_length);
  points.insert(points.end(), bottom.begin(), bottom.end());
  return points;
}

/// Volume and second moments by sections z = const: `section(z)` is the radius there.
MassProperties revolved(const auto& section, double top) {
  constexpr int kSlices = 200000;
  MassProperties mass;
  Vector3 moment = Vector3::Zero();
  for (int i = 0; i < kSlices; ++i) {
    const double z = top * (2 * (i + 0.5) / kSlices - 1), r2 = section(z) * section(z),
                 slice = std::numbers::pi * r2 * 2 * top / kSlices;
    mass.volume += slice;
    moment += slice * Vector3(r2 / 4, r2 / 4, z * z);
  }
  mass.second_moment = moment.asDiagonal();
  return mass;
}

void check_mass(const MassProperties& mass, const MassProperties& expected, double tolerance) {
  CHECK(mass.volume == relative(expected.volume).epsilon(tolerance));
  CHECK((mass.second_moment - expected.second_moment).norm() <= tolerance * expected.second_moment.norm());
  CHECK((mass.centroid - expected.centroid).norm() <= tolerance * (1 + expected.centroid.norm()));
  CHECK(mass.relative_error <= 1e-14);
}

}  // namespace

TEST_CASE("box: support and points against its vertices; mass of its closed form") {
  const Vector3 half(3, 2, 0.5);
  check_against(Box(half), box_corners(half), normals_of_test(61), 1e-15);
  CHECK(Box(half).half_extents() == half);
  const MassProperties mass = Box(half).mass_properties();
  CHECK(mass.volume == 24);
  CHECK((mass.second_moment.diagonal() - Vector3(72, 32, 2)).norm() <= 1e-13);
  check_against(Box(Vector3(1, 2, 0)), box_corners(Vector3(1, 2, 0)), normals_of_test(62), 1e-15);
}

TEST_CASE("capsule: support and points against a sweep of a sphere; mass by slices") {
  const double radius = 0.5, half_length = 1.5;
  std::vector<Vector3> boundary;
  for (const Vector3& n : random_normals(20000, 63)) {
    boundary.emplace_back(radius * n + Vector3(0, 0, std::copysign(half_length, n.z())));
  }
  check_against(Capsule(radius, half_length), boundary, normals_of_test(64), 3e-4);
  const auto section = [&](double z) {
    const double over = std::max(std::abs(z) - half_length, 0.0);
    return std::sqrt(radius * radius - over * over);
  };
  check_mass(Capsule(radius, half_length).mass_properties(), revolved(section, half_length + radius), 1e-9);
  check_mass(Capsule(2, 0).mass_properties(), Sphere(2).mass_properties(), 1e-15);
  const auto swept = std::make_shared<Rounded>(std::make_shared<Capsule>(0.1, half_length), 0.15);
  check_mass(Rounded(swept, 0.25).mass_properties(), Capsule(radius, half_length).mass_properties(), 1e-15);
  CHECK_FALSE(Capsule(2, 0).traits().has_nonsmooth_points);
  for (const Vector3& n : random_normals(10, 65)) {
    CHECK(Capsule(2, 0).point(n) == Sphere(2).point(n));
    CHECK(Capsule(0, 2).support(n) == relative(2 * std::abs(n.z())));
  }
}

TEST_CASE("cylinder: support and points against its rims; mass by slices") {
  const double radius = 0.5, half_length = 1.5;
  check_against(Cylinder(radius, half_length), cylinder_points(radius, half_length), normals_of_test(66), 2e-4);
  check_mass(Cylinder(radius, half_length).mass_properties(), revolved([&](double) { return radius; }, half_length), 1e-9);
  check_against(Cylinder(2, 0), cylinder_points(2, 0), normals_of_test(67), 2e-4);
}

TEST_CASE("cylinder: the vertices of a cap have the given point between them, the vertices of the side are its two ends") {
  const Cylinder cylinder(2, 1);
  for (const double sign : {1.0, -1.0}) {
    ActiveVertices cap;
    cylinder.add_active_vertices(Vector3(0, 0, sign), Vector3(0.5, 0.7, 3), cap);
    REQUIRE(cap.size() == 3);
    Vector3 middle = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      CHECK(cap[k].z() == sign);
      CHECK(cap[k].head<2>().norm() == relative(2).epsilon(1e-15));
      middle += cap[k] / 3;
    }
    CHECK((middle - Vector3(0, 0, sign)).norm() <= 1e-15);
    CHECK(cap[0].head<2>().normalized().dot(Eigen::Vector2d(0.5, 0.7).normalized()) == relative(1).epsilon(1e-15));
  }
  ActiveVertices side;
  cylinder.add_active_vertices(Vector3(0.6, 0.8, 0), Vector3(5, 5, 0), side);
  REQUIRE(side.size() == 2);
  CHECK((side[0] - Vector3(1.2, 1.6, -1)).norm() <= 1e-15);
  CHECK((side[1] - Vector3(1.2, 1.6, 1)).norm() <= 1e-15);
}

TEST_CASE("polytope: support and points against its points, whatever lies inside, in a plane or twice") {
  std::vector<Vector3> points = box_corners(Vector3(3, 2, 0.5));
  points.emplace_back(0, 0, 0.5);
  points.emplace_back(0.1, 0.2, 0.3);
  points.push_back(points.front());
  check_against(Polytope(points), points, normals_of_test(68), 1e-15);
  CHECK(Polytope(points).half_extents() == Vector3(3, 2, 0.5));
  const std::vector<Vector3> cloud = random_normals(200, 69);
  check_against(Polytope(cloud), cloud, normals_of_test(70), 1e-15);
  const std::vector<Vector3> triangle(cloud.begin(), cloud.begin() + 3);
  check_against(Polytope(triangle), triangle, normals_of_test(71), 1e-15);
}

TEST_CASE("polytope: mass of a box, rotated and moved, with points in its faces, inside and twice") {
  const Vector3 half(3, 2, 0.5);
  std::vector<Vector3> points = box_corners(half);
  const std::vector<Vector3> vertices = points;
  for (const Vector3& vertex : vertices) {
    points.emplace_back(vertex.cwiseProduct(Vector3(0.3, -0.7, 1)));
    points.emplace_back(0.5 * vertex);
    points.push_back(vertex);
  }
  for (const double angle : {0.0, 0.3, 0.77, 2.1}) {
    const Matrix3 rotation = Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    const Vector3 position = angle * Vector3(5, -3, 1);
    std::vector<Vector3> placed;
    placed.reserve(points.size());
    for (const Vector3& point : points) placed.emplace_back(rotation * point + position);
    MassProperties expected = Box(half).mass_properties();
    expected.centroid = position;
    expected.second_moment =
        (rotation * expected.second_moment * rotation.transpose() + expected.volume * position * position.transpose()).eval();
    check_mass(Polytope(placed).mass_properties(), expected, 1e-14);
  }
}

TEST_CASE("polytope: mass of tetrahedron, octahedron, needles and a fine sphere") {
  const std::vector<Vector3> tetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const MassProperties mass = Polytope(tetrahedron).mass_properties();
  CHECK(mass.volume == relative(1).epsilon(1e-15));
  CHECK((mass.centroid - Vector3(0.25, 0.5, 0.75)).norm() <= 1e-15);
  // For it the integral of x^2 is V a^2/10, and of x y V a b/20.
  CHECK(mass.second_moment(0, 0) == relative(0.1).epsilon(1e-14));
  CHECK(mass.second_moment(1, 2) == relative(6.0 / 20).epsilon(1e-14));
  for (const double thinness : {1.0, 1e-3, 1e-9}) {
    const std::vector<Vector3> octahedron = {{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, thinness}, {0, 0, -thinness}};
    CHECK(Polytope(octahedron).mass_properties().volume == relative(8 * thinness / 3).epsilon(1e-14));
  }
  const std::vector<Vector3> fine = random_normals(2000, 72);
  const MassProperties ball = Polytope(fine).mass_properties();
  CHECK(ball.relative_error <= 1e-4);  // no more than the lattice can miss
  CHECK(ball.volume < 4 * std::numbers::pi / 3);
  CHECK(ball.volume == relative(4 * std::numbers::pi / 3).epsilon(0.02));
}

TEST_CASE("polytope: what lies flat has no volume") {
  const std::vector<Vector3> point = {{1, 2, 3}};
  const std::vector<Vector3> triangle = {{1, 2, 3}, {2, 2, 4}, {0, 1, 1}};
  const std::vector<Vector3> square = {{0, 0, 0}, {1, 0, 1}, {0, 1, 0}, {1, 1, 1}};
  for (const auto& points : {point, triangle, square}) CHECK(Polytope(points).mass_properties().volume <= 1e-15);
}

TEST_CASE("box, capsule, cylinder, polytope: what is no body is refused") {
  CHECK_THROWS_WITH_AS(Box(Vector3(1, -1, 1)), "half-length y = -1 m is outside [0, 1e+30] m", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Capsule(-1, 1), "radius = -1 m is outside [0, 1e+30] m", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Cylinder(1, std::numeric_limits<double>::quiet_NaN()), "half-length = nan m is outside [0, 1e+30] m",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Polytope({}), "points is empty; at least one is needed", std::invalid_argument);
}
