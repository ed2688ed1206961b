// Gaps of bodies and closed meshes, apart and overlapping, against branch and bound on the solid hull. The reference uses no solver
// of lib/proximity. The distance from a body to a surface, against one query per triangle.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/mesh/mesh_triangle.hpp"
#include "proximity/collider_reference.hpp"
#include "supernormal/contact/body_box.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"
#include "support/mesh_samples.hpp"
#include "support/relative.hpp"
#include "support/rotation_between.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr std::array kMeshGaps = {0.5, 0.05, 0.01, 0.0, -0.01, -0.03, -0.1};  // relative to the smallest half-extent

double height_over(const Shape& shape, const Pose& pose, const Vector3& normal, const Vector3& point) {
  return normal.dot(point - pose.position) - shape.support(pose.rotation.transpose() * normal);
}

}  // namespace

TEST_CASE(
    "bodies and closed meshes, apart, touching or overlapping by up to 10 %: the gap is right to 1e-9, and the points are on "
    "both surfaces") {
  Draw draw(31);
  const std::array<TriangleMesh, 4> meshes = {
      icosahedron_mesh(), box_mesh({0.9, 1.4, 0.7}), hull_mesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}),
      hull_mesh({{1, 0, 0}, {-1, 0, 0}, {0, 1.5, 0}, {0, -1.5, 0}, {0, 0, 0.3}, {0, 0, -2}})};
  MeshContacts query;
  double worst = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(draws(2000)); ++i) {
    CAPTURE(i);
    const TriangleMesh& mesh = meshes[i % meshes.size()];
    const Polytope hull(mesh.vertices);
    const Pose mesh_pose{draw.in_box({5, 5, 5}), draw.rotation()};
    const std::unique_ptr<Shape> body = draw_body(draw);
    const double unit = std::min(body->half_extents().minCoeff(), hull.half_extents().minCoeff());
    const Matrix3 turn = draw.rotation();
    const Vector3 way = draw.direction();
    const Pose pose = placed_at_gap(kMeshGaps[i % kMeshGaps.size()] * unit, *body, turn, hull, mesh_pose, way);
    const GapBounds expected = bound_gap(*body, pose, hull, mesh_pose, 1e-10 * unit);
    REQUIRE(expected.upper - expected.lower <= 1.1e-10 * unit);
    const std::vector<MeshTriangle> triangles = mesh.placed(mesh_pose);
    const std::span<const MeshContact> contacts = query.find(*body, pose, triangles, {});
    if (std::abs(expected.lower) > 1e-9 * unit) REQUIRE(contacts.empty() == (expected.lower > 0));
    const Proximity found = contacts.empty() ? find_nearest_triangle(*body, pose, triangles, {}).proximity : contacts[0].proximity;
    worst = std::max({worst, (expected.lower - found.gap) / unit, (found.gap - expected.upper) / unit});
    CHECK(contacts.size() <= 1);
    CHECK(std::abs(found.normal.dot(found.point2 - found.point1) - found.gap) < 1e-9 * unit);
    CHECK(found.gap > expected.lower - 1e-9 * unit);
    CHECK(found.gap < expected.upper + 1e-9 * unit);
    CHECK(std::abs(height_over(*body, pose, found.normal, found.point1)) < 1e-9 * unit);
    CHECK(std::abs(height_over(hull, mesh_pose, -found.normal, found.point2)) < 1e-9 * unit);
  }
  MESSAGE("worst gap error / smallest half-extent: ", worst);
}

// The radius of curvature vanishes at a vertex of an exponent below 2, and only there.
TEST_CASE("bodies with a vertex deep in an edge of a mesh: no shorter translation is missed") {
  Draw draw(32);
  const TriangleMesh mesh = box_mesh({0.9, 1.4, 0.7});
  const Polytope hull(mesh.vertices);
  const std::vector<MeshTriangle> triangles = mesh.placed({});
  constexpr std::array kDepths = {0.005, 0.02, 0.06, 0.15, 0.3};  // relative to the smallest half-extent
  MeshContacts query;
  for (std::size_t i = 0; i < 600; ++i) {
    CAPTURE(i);
    const Vector3 half = draw.in_box({0.35, 0.35, 0.35}) + Vector3::Constant(0.65);
    const Vector3 exponents = draw.in_box({0.375, 0.375, 0}) + Vector3::Constant(1.575);
    const Superellipsoid body(half, exponents.x(), exponents.y());
    const double unit = half.minCoeff();
    // One vertex of the body points into the edge of the box at (0.9, 1.4), nearly.
    const Vector3 aside = draw.in_box({1, 1, 1});
    const double angle = std::numbers::pi / 4 * (1 + 0.9 * aside.x());
    const Vector3 inwards = (Vector3(-std::cos(angle), -std::sin(angle), 0) + std::pow(10, -1 - aside.y()) * aside).normalized();
    const auto axis = static_cast<int>(i % 3);
    const Matrix3 turn = test::rotation_between(Vector3::Unit(axis), inwards).toRotationMatrix() *
                         Eigen::AngleAxisd(std::numbers::pi * aside.z(), Vector3::Unit(axis)).toRotationMatrix();
    const double depth = kDepths[i / 3 % kDepths.size()] * unit;
    const Pose pose{Vector3(0.9, 1.4, 0.3 * aside.z()) - (half[axis] - depth) * inwards, turn};
    const Proximity expected = find_proximity(body, pose, hull, {}, {.certify_depth = true});
    REQUIRE(expected.is_global);
    const std::span<const MeshContact> contacts = query.find(body, pose, triangles, {});
    if (expected.gap < -1e-9 * unit) REQUIRE(!contacts.empty());
    if (!contacts.empty()) CHECK(contacts[0].proximity.gap > expected.gap - 1e-6 * unit);
  }
}

TEST_CASE("the nearest of many triangles is found from both sides") {
  Draw draw(21);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    TriangleMesh mesh = i % 2 == 0 ? icosahedron_mesh() : floor_mesh(6, 0.6);
    for (Vector3& vertex : mesh.vertices) vertex += draw.in_box({0.1, 0.1, 0.1});
    const std::vector<MeshTriangle> triangles = mesh.placed({draw.in_box({50, 50, 50}), draw.rotation()});
    const std::unique_ptr<Shape> body = draw_body(draw);
    const Pose pose{triangles[0].vertices[0] + draw.uniform(1.2, 6) * draw.direction(), draw.rotation()};
    double least = std::numeric_limits<double>::infinity();
    int evaluations = 0;
    for (const MeshTriangle& triangle : triangles) {
      const Proximity each = find_triangle_proximity(*body, pose, triangle.vertices, {});
      least = std::min(least, each.gap);
      evaluations += each.evaluations;
    }
    if (least < 1e-9) continue;
    const MeshContact nearest = find_nearest_triangle(*body, pose, triangles, {});
    const double unit = body->half_extents().minCoeff();
    CHECK(nearest.proximity.status == Status::Converged);
    CHECK(std::abs(nearest.proximity.gap - least) < 2e-9 * unit);
    CHECK(nearest.proximity.evaluations < evaluations / 2);
    const auto& vertices = triangles[static_cast<std::size_t>(nearest.triangle)].vertices;
    CHECK(std::abs(find_triangle_proximity(*body, pose, vertices, {}).gap - nearest.proximity.gap) < 2e-9 * unit);
  }
}

TEST_CASE("the nearest triangle of degenerate and unusable triangles, or of none") {
  const Ellipsoid body(Vector3::Ones());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vector3 a{3, 0, 0};
  const Vector3 b{4, 1, 0};
  const std::array<MeshTriangle, 4> triangles = {{{{a, a, a}, 1}, {{b, a, b}, 2}, {{a, b, Vector3(0, 0, nan)}, 3}, {{b, b, b}, 4}}};
  const MeshContact nearest = find_nearest_triangle(body, {}, triangles, {});
  CHECK(nearest.proximity.gap == relative(2).epsilon(1e-9));
  CHECK(nearest.triangle <= 2);
  CHECK(find_nearest_triangle(body, {}, std::span(triangles).subspan(2, 1), {}).proximity.status == Status::InvalidInput);
  CHECK(find_nearest_triangle(body, {}, {}, {}).proximity.status == Status::InvalidInput);
}

TEST_CASE("the box of a body selects the triangles at distance 0") {
  Draw draw(61);
  int touching = 0;
  for (int i = 0; i < 5000; ++i) {
    CAPTURE(i);
    const BodyBox box{draw.in_box({0.3, 0.3, 0.3}), {draw.uniform(0.1, 1), draw.uniform(0.1, 1), draw.uniform(0.1, 1)}};
    const Pose pose{draw.in_box({3, 3, 3}), draw.rotation()};
    std::array<Vector3, 3> vertices;
    for (Vector3& vertex : vertices) vertex = pose.position + draw.in_box({1.5, 1.5, 1.5});
    if (i % 10 == 0) vertices[2] = vertices[1];
    const Pose of_box{pose.position + pose.rotation * box.centre, pose.rotation};
    const double gap = find_triangle_proximity(Box(box.half_lengths), of_box, vertices, {}).gap;
    if (std::abs(gap) < 1e-9) continue;
    CHECK(box.touches(pose, vertices) == (gap < 0));
    if (gap < 0) ++touching;
  }
  CHECK(touching > 1000);
  CHECK(touching < 4000);
}

TEST_CASE("the box of a body does not rule out triangles that are not finite") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const BodyBox box{Vector3::Zero(), Vector3::Ones()};
  CHECK(box.touches({}, {Vector3(nan, nan, nan), Vector3(nan, nan, nan), Vector3(nan, nan, nan)}));
}

TEST_CASE("the box of an asymmetric body reaches to both its ends") {
  const std::array<Vector3, 2> points = {Vector3(0.5, -2, 0.25), Vector3(0, 0, 0.75)};
  const BodyBox box = BodyBox::of(Polytope(points));
  CHECK(box.centre == Vector3(0.25, -1, 0.5));
  CHECK(box.half_lengths == Vector3(0.25, 1, 0.25));
  CHECK(box.contains({0, 0, 0.25}, 0));
  CHECK(!box.contains({-0.01, 0, 0.25}, 0));
  CHECK(box.contains({-0.01, 0, 0.25}, 0.02));
}
