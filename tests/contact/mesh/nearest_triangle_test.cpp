// The distance from a body to a surface, against one query per triangle.
#include <doctest/doctest.h>

#include <limits>

#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
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
