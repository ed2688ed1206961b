// Surfaces and bodies for the tests of mesh contacts.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"

namespace supernormal::test {

struct TriangleMesh {
  std::vector<Vector3> vertices;
  std::vector<std::array<int, 3>> triangles;

  int add(const Vector3& vertex) {
    vertices.push_back(vertex);
    return static_cast<int>(vertices.size()) - 1;
  }

  std::vector<MeshTriangle> placed(const Pose& pose = {}) const {
    std::vector<MeshTriangle> out;
    for (const std::array<int, 3>& corners : triangles) {
      MeshTriangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.vertices[k] = pose.rotation * vertices[static_cast<std::size_t>(corners[k])] + pose.position;
      }
      triangle.index = static_cast<int>(out.size());
      out.push_back(triangle);
    }
    return out;
  }
};

/// A level rectangle of x_cells * y_cells * 2 triangles. Its first corner is at (x, y) cells.
inline TriangleMesh sheet_mesh(int x_cells, int y_cells, double cell, double x = 0, double y = 0) {
  TriangleMesh mesh;
  for (int i = 0; i <= x_cells; ++i) {
    for (int j = 0; j <= y_cells; ++j) mesh.add({(i + x) * cell, (j + y) * cell, 0});
  }
  for (int i = 0; i < x_cells; ++i) {
    for (int j = 0; j < y_cells; ++j) {
      const int a = i * (y_cells + 1) + j;
      const int b = a + y_cells + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({b, b + 1, a + 1});
    }
  }
  return mesh;
}

/// A level square, centred at the origin.
inline TriangleMesh floor_mesh(int cells, double cell) { return sheet_mesh(cells, cells, cell, -0.5 * cells, -0.5 * cells); }

/// The closed surface of the hull of points in general position or with quadrangles, from every supporting triangle, outward. Slow
/// for many points.
inline TriangleMesh hull_mesh(const std::vector<Vector3>& points) {
  TriangleMesh mesh;
  mesh.vertices = points;
  const int count = static_cast<int>(points.size());
  const auto point = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      for (int c = b + 1; c < count; ++c) {
        const Vector3 normal = (point(b) - point(a)).cross(point(c) - point(a));
        double low = 0;
        double high = 0;
        for (int i = 0; i < count; ++i) {
          const double height = normal.dot(point(i) - point(a)) / normal.norm();
          low = std::min(low, height);
          high = std::max(high, height);
        }
        if (high < 1e-9) mesh.triangles.push_back({a, b, c});
        if (low > -1e-9) mesh.triangles.push_back({a, c, b});
      }
    }
  }
  return mesh;
}

inline TriangleMesh icosahedron_mesh() {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vector3> points;
  for (const double one : {-1.0, 1.0}) {
    for (const double phi : {-golden, golden}) {
      points.emplace_back(0, one, phi);
      points.emplace_back(one, phi, 0);
      points.emplace_back(phi, 0, one);
    }
  }
  return hull_mesh(points);
}

/// A box of triangles. With `inward` it is a room instead of a block.
inline TriangleMesh box_mesh(const Vector3& half_lengths, bool inward = false) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vector3 sign{(i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0};
    mesh.add(half_lengths.cwiseProduct(sign));
  }
  const std::array<std::array<int, 4>, 6> sides = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : sides) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  if (inward) {
    for (std::array<int, 3>& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

/// An ellipsoid, or a superellipsoid with exponents from the range 1.02…200.
inline std::unique_ptr<Shape> draw_body(Draw& draw) {
  const Vector3 half_axes = draw.within(0.4, 1.2);
  if (draw.uniform(0, 1) < 0.3) return std::make_unique<Ellipsoid>(half_axes);
  const double delta = 1 + draw.log_uniform(0.02, 200);
  return std::make_unique<Superellipsoid>(half_axes, delta, 1 + draw.log_uniform(0.02, 200));
}

/// The contacts, copied from one reused query object.
inline std::vector<MeshContact> contacts_of(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles) {
  static MeshContacts query;
  const std::span<const MeshContact> found = query.find(shape, pose, triangles, {});
  return {found.begin(), found.end()};
}

/// The outward unit normal.
inline Vector3 normal_of(const MeshTriangle& t) {
  return (t.vertices[1] - t.vertices[0]).cross(t.vertices[2] - t.vertices[0]).normalized();
}

/// The pose of the body moved along `way` (unit) from the middle of the hull until it has the wanted gap, m.
inline Pose placed_at_gap(double wanted, const Shape& body, const Matrix3& rotation, const Shape& hull, const Pose& hull_pose,
                          const Vector3& way) {
  Pose pose{hull_pose.position, rotation};
  double inside = 0;
  double outside = 10;
  for (int step = 0; step < 25; ++step) {
    const double middle = 0.5 * (inside + outside);
    pose.position = hull_pose.position + middle * way;
    (find_proximity(body, pose, hull, hull_pose).gap < wanted ? inside : outside) = middle;
  }
  return pose;
}

}  // namespace supernormal::test
