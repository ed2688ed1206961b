// The distance from a body to a surface, against one query per triangle.
#include <doctest/doctest.h>

#include <limits>

#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/contact/body_box.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "support/mesh_samples.hpp"
#include "support/relative.hpp"

using namespace supernormal;
using namespace supernormal::test;

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
