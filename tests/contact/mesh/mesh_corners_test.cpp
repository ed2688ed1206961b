// A body in the concave parts of a mesh: one contact for each side that supports it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/mesh_samples.hpp"
#include "support/relative.hpp"
#include "support/rotation_between.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

// Nearly a rhombic bipyramid. Its tip is the deepest point for all normals within 45 degrees of the axis.
const Superellipsoid kTip({0.5, 0.5, 1.5}, 1.02, 1.02);

// The pose with the tip nearly along (1, 1, 1), at these depths beyond the planes x = 3, y = 4, z = 5.
Pose pressed_into_corner(Draw& draw, const Vector3& depths) {
  Pose pose;
  pose.rotation = rotation_between(Vector3::UnitZ(), Vector3::Ones() + draw.in_box({0.1, 0.1, 0.1})).toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    pose.position[axis] = Vector3(3, 4, 5)[axis] + depths[axis] - kTip.support(pose.rotation.transpose() * Vector3::Unit(axis));
  }
  return pose;
}

void check_is_held_by_all_walls(const std::vector<MeshContact>& contacts, const Vector3& depths) {
  REQUIRE(contacts.size() == 3);
  Vector3 sum = Vector3::Zero();
  for (const MeshContact& contact : contacts) {
    int axis = 0;
    CHECK(contact.proximity.normal.maxCoeff(&axis) == 1);
    CHECK(contact.proximity.gap == relative(-depths[axis]).epsilon(1e-12));
    sum += contact.proximity.normal;
  }
  CHECK(sum == Vector3::Ones());
}

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

TEST_CASE("valleys and room corners give one contact for each side") {
  const Ellipsoid ball(Vector3::Ones());
  // Two slopes meet at 90 degrees, with the valley along y.
  TriangleMesh valley;
  for (const double x : {-4.0, 0.0, 4.0}) {
    for (const double y : {-3.0, 3.0}) valley.add({x, y, std::abs(x)});
  }
  valley.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
  const double height = std::sqrt(2.0) * 0.99;
  std::vector<MeshContact> contacts = contacts_of(ball, {{0, 0.2, height}, Matrix3::Identity()}, valley.placed());
  REQUIRE(contacts.size() == 2);
  for (const MeshContact& contact : contacts) {
    CHECK(contact.proximity.gap == relative(-0.01).epsilon(1e-12));
    CHECK(contact.proximity.normal.z() == relative(-std::sqrt(0.5)).epsilon(1e-12));
  }
  CHECK(contacts[0].proximity.normal.x() == relative(-contacts[1].proximity.normal.x()));

  const std::vector<MeshTriangle> room = box_mesh({3, 4, 5}, true).placed();
  contacts = contacts_of(ball, {{2.01, 3.02, -4.03}, Matrix3::Identity()}, room);
  REQUIRE(contacts.size() == 3);
  CHECK(contacts[0].proximity.gap == relative(-0.03).epsilon(1e-12));
  CHECK(contacts[1].proximity.gap == relative(-0.02).epsilon(1e-12));
  CHECK(contacts[2].proximity.gap == relative(-0.01).epsilon(1e-12));
  CHECK((contacts[0].proximity.normal + Vector3::UnitZ()).norm() == 0);
  CHECK((contacts[1].proximity.normal - Vector3::UnitY()).norm() == 0);
  CHECK((contacts[2].proximity.normal - Vector3::UnitX()).norm() == 0);
}

TEST_CASE("a sharp tip pressed into a corner of three walls has a contact with each wall") {
  Draw draw(5);
  const std::vector<MeshTriangle> room = box_mesh({3, 4, 5}, true).placed();
  // The same walls, but each continues behind the others: the mesh intersects itself.
  std::vector<MeshTriangle> crossing;
  for (int axis = 0; axis < 3; ++axis) {
    Pose wall;
    wall.position = Vector3(3, 4, 5)[axis] * Vector3::Unit(axis);
    wall.rotation << Vector3::Unit((axis + 2) % 3), Vector3::Unit((axis + 1) % 3), -Vector3::Unit(axis);
    for (const MeshTriangle& triangle : floor_mesh(8, 2).placed(wall)) crossing.push_back(triangle);
  }
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const Vector3 depths{draw.uniform(0.001, 0.05), draw.uniform(0.001, 0.05), draw.uniform(0.001, 0.05)};
    const Pose pose = pressed_into_corner(draw, depths);
    check_is_held_by_all_walls(contacts_of(kTip, pose, room), depths);
    check_is_held_by_all_walls(contacts_of(kTip, pose, crossing), depths);
  }
}

TEST_CASE("a body in a finely divided bowl gets a few contacts") {
  TriangleMesh bowl = floor_mesh(60, 0.05);
  for (Vector3& vertex : bowl.vertices) vertex.z() = 0.25 * (vertex.x() * vertex.x() + vertex.y() * vertex.y());
  const std::vector<MeshTriangle> triangles = bowl.placed();
  Draw draw(8);
  for (int i = 0; i < 30; ++i) {
    const Superellipsoid body({0.6, 0.5, 0.4}, draw.uniform(1.5, 8), draw.uniform(1.5, 8));
    Pose pose{{draw.uniform(-0.2, 0.2), draw.uniform(-0.2, 0.2), 0}, draw.rotation()};
    pose.position.z() = 0.1 - find_plane_proximity(body, pose, Vector3::UnitZ(), 0).gap;
    const std::vector<MeshContact> contacts = contacts_of(body, pose, triangles);
    for (std::size_t a = 0; a < contacts.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const Proximity& one = contacts[a].proximity;
        const Proximity& other = contacts[b].proximity;
        CHECK(((one.normal - other.normal).norm() > 1e-6 || (one.point1 - other.point1).norm() > 1e-7));
      }
    }
    CHECK(contacts.size() <= 12);
  }
}

// y is up, as on a heightfield.
TEST_CASE("a ball is as deep in a terrain as its centre is near: over a valley that ends at a vertex, and through a thin ridge") {
  struct Place {
    std::array<std::array<double, 3>, 3> heights;  // m; of the vertices (3, y, 4) to (5, y, 6), by their third coordinate
    Vector3 centre;                                // m; of a cube of centres
    double half_side;                              // m; of the cube
    double radius;                                 // m
  };
  // The valley is between two edges that meet at the vertex (4, 1.5, 5). Their hull bridges it. The ball behind the ridge shows on
  // its other side. It must come out where it came in.
  const Place over_valley{{{{0, 2, 2}, {0, 1.5, 2}, {0, 0, 0}}}, {4.04, 2.17, 4.94}, 0.15, 0.75};
  const Place through_ridge{{{{0, 0, 2.36}, {2.36, 1.43, 0.05}, {0, 0, 0.05}}}, {3.97, 1.14, 4.55}, 0.05, 0.586};
  for (const Place& place : {over_valley, through_ridge}) {
    const auto vertex = [&](int i, int j) {
      const bool is_flat = i < 3 || i > 5 || j < 4 || j > 6;
      return Vector3(i, is_flat ? 0 : place.heights[static_cast<std::size_t>(j - 4)][static_cast<std::size_t>(i - 3)], j);
    };
    std::vector<MeshTriangle> terrain;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) {
        terrain.push_back({{vertex(i, j), vertex(i, j + 1), vertex(i + 1, j)}, 2 * (8 * i + j)});
        terrain.push_back({{vertex(i + 1, j + 1), vertex(i + 1, j), vertex(i, j + 1)}, 2 * (8 * i + j) + 1});
      }
    }
    Draw draw(9);
    for (int i = 0; i < 1000; ++i) {
      CAPTURE(i);
      const double radius = place.radius * draw.uniform(0.8, 1.2);
      const Ellipsoid ball(Vector3::Constant(radius));
      const Pose pose{place.centre + draw.in_box(Vector3::Constant(place.half_side)), Matrix3::Identity()};
      const std::vector<MeshContact> contacts = contacts_of(ball, pose, terrain);
      const double nearest = find_nearest_triangle(Ellipsoid(Vector3::Constant(1e-3)), pose, terrain).proximity.gap + 1e-3;
      if (nearest > radius) continue;
      REQUIRE(!contacts.empty());
      CHECK(contacts[0].proximity.gap == doctest::Approx(nearest - radius).epsilon(1e-6));
    }
  }
}

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
