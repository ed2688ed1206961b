// Tests that the manifold points stay on the floor.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/relative.hpp"

using namespace supernormal;

namespace {

/// Adds the rectangle from (x0, y0) to (x1, y1) at height z, in 2 * columns triangles.
void add_rectangle(double x0, double y0, double x1, double y1, double z, int columns, std::vector<MeshTriangle>& triangles) {
  for (int k = 0; k < columns; ++k) {
    const double left = x0 + (x1 - x0) * k / columns;
    const double right = x0 + (x1 - x0) * (k + 1) / columns;
    const int index = static_cast<int>(triangles.size());
    triangles.push_back({{Vector3(left, y0, z), Vector3(right, y0, z), Vector3(right, y1, z)}, index});
    triangles.push_back({{Vector3(left, y0, z), Vector3(right, y1, z), Vector3(left, y1, z)}, index + 1});
  }
}

/// The manifold of a brick with half-axes 0.1, 0.07, 0.05 at rest on z = 0.
ContactManifold manifold_on_plane(double depth = 1e-5) {
  const Superellipsoid brick(Vector3(0.1, 0.07, 0.05), 20, 20);
  const Pose pose{Vector3(0, 0, 0.05 - depth), Matrix3::Identity()};
  return find_plane_contact_manifold(brick, pose, find_plane_proximity(brick, pose, Vector3::UnitZ(), 0));
}

}  // namespace

TEST_CASE("on a floor of triangles in any order all manifold points stay") {
  std::vector<MeshTriangle> floor;
  add_rectangle(-1, -1, 1, 0.01, 0, 40, floor);
  add_rectangle(-1, 0.01, 1, 1, 0, 33, floor);
  add_rectangle(-1, -1, 1, 1, -0.5, 1, floor);  // a cellar
  std::mt19937_64 random(1);
  for (int repetition = 0; repetition < 20; ++repetition) {
    std::shuffle(floor.begin(), floor.end(), random);
    const ContactManifold plane = manifold_on_plane();
    ContactManifold manifold = plane;
    draw_in_corners(manifold, floor);
    REQUIRE(manifold.corner_count == 4);
    for (std::size_t k = 0; k < 4; ++k) CHECK(manifold.corners[k].point == plane.corners[k].point);
  }
}

TEST_CASE("on triangles with vertices 1e-6 of their size apart all manifold points stay, at any depth") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> apart(-3e-7, 3e-7);  // for triangles with sides of 1
  for (const double depth : {1e-5, 1e-8, 1e-11}) {
    for (int repetition = 0; repetition < 20; ++repetition) {
      std::vector<MeshTriangle> floor;
      add_rectangle(-1, -1, 0.01, 0.02, 0, 1, floor);
      add_rectangle(0.01, -1, 1, 0.02, 0, 1, floor);
      add_rectangle(-1, 0.02, 1, 1, 0, 2, floor);
      for (MeshTriangle& triangle : floor) {
        for (Vector3& vertex : triangle.vertices) vertex += Vector3(apart(random), apart(random), apart(random));
      }
      ContactManifold manifold = manifold_on_plane(depth);
      REQUIRE(manifold.corner_count == 4);
      const ContactManifold plane = manifold;
      draw_in_corners(manifold, floor);
      REQUIRE(manifold.corner_count == 4);
      for (std::size_t k = 0; k < 4; ++k) CHECK((manifold.corners[k].point - plane.corners[k].point).norm() < 1e-5);
    }
  }
}

TEST_CASE("manifold points beyond the border of a table move in to it") {
  std::vector<MeshTriangle> table;
  add_rectangle(-1, -1, 0.03, 1, 0, 7, table);
  ContactManifold manifold = manifold_on_plane();
  draw_in_corners(manifold, table);
  REQUIRE(manifold.corner_count == 4);
  double farthest = -1;
  for (const ManifoldCorner& corner : manifold.corners) {
    CHECK(corner.point.x() <= 0.03 + 1e-6);
    CHECK(std::abs(corner.point.z()) <= manifold.margin);
    CHECK(corner.depth <= -manifold.deepest.gap);
    farthest = std::max(farthest, corner.point.x());
  }
  CHECK(farthest == test::relative(0.03).epsilon(1e-4));
}

TEST_CASE("manifold points do not stay beyond a gap in the floor or over a step") {
  std::vector<MeshTriangle> floor;
  add_rectangle(-1, -1, 0.03, 1, 0, 7, floor);
  add_rectangle(0.05, -1, 1, 1, 0, 7, floor);
  add_rectangle(0.03, -1, 0.05, 1, -0.01, 1, floor);
  ContactManifold manifold = manifold_on_plane();
  draw_in_corners(manifold, floor);
  for (int k = 0; k < manifold.corner_count; ++k) CHECK(manifold.corners[static_cast<std::size_t>(k)].point.x() <= 0.03 + 1e-6);
}

TEST_CASE("without a face under the deepest point there are no manifold points") {
  std::vector<MeshTriangle> beside;
  add_rectangle(0.05, -1, 1, 1, 0, 7, beside);
  ContactManifold manifold = manifold_on_plane();
  draw_in_corners(manifold, beside);
  CHECK(manifold.corner_count == 0);
  std::vector<MeshTriangle> slope;
  add_rectangle(-1, -1, 1, 1, 0, 1, slope);
  for (MeshTriangle& triangle : slope) {
    for (Vector3& vertex : triangle.vertices) vertex.z() = 0.01 * vertex.x();
  }
  manifold = manifold_on_plane();
  draw_in_corners(manifold, slope);
  CHECK(manifold.corner_count == 0);
}
