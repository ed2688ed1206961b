#include "common/polyhedron.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace common {
namespace {

using supernormal::Vector3;

double signed_power(double x, double exponent) { return std::copysign(std::pow(std::abs(x), exponent), x); }

/// The point of the surface (|x|^delta + |y|^delta)^(epsilon/delta) + |z|^epsilon = 1 in a direction of the parameters.
Vector3 surface_point(double x, double y, double z, double delta, double epsilon) {
  const double across = std::pow(std::hypot(x, y), 2 / epsilon);
  const double length = std::hypot(x, y);
  return {across * signed_power(x / length, 2 / delta), across * signed_power(y / length, 2 / delta), signed_power(z, 2 / epsilon)};
}

/// The gradient of the left side of this equation, divided by epsilon.
Vector3 gradient(const Vector3& p, double delta, double epsilon) {
  const double across = std::pow(std::pow(std::abs(p.x()), delta) + std::pow(std::abs(p.y()), delta), 1 / delta);
  const double factor = std::pow(across, epsilon - 1);
  return {factor * signed_power(p.x() / across, delta - 1), factor * signed_power(p.y() / across, delta - 1),
          signed_power(p.z(), epsilon - 1)};
}

}  // namespace

Polyhedron superellipsoid_mesh(const Vector3& half_axes, double delta, double epsilon, double rounding, MeshSize size) {
  const auto [meridians, rings] = size;
  Polyhedron mesh;
  for (unsigned ring = 1; ring <= rings; ++ring) {
    const double latitude = std::numbers::pi * (static_cast<double>(ring) / (rings + 1) - 0.5);
    const double across = std::cos(latitude);
    for (unsigned k = 0; k < meridians; ++k) {
      const double longitude = 2 * std::numbers::pi * k / meridians;
      const Vector3 unit =
          surface_point(across * std::cos(longitude), across * std::sin(longitude), std::sin(latitude), delta, epsilon);
      const Vector3 normal = gradient(unit, delta, epsilon).cwiseQuotient(half_axes).normalized();
      mesh.vertices.emplace_back(half_axes.cwiseProduct(unit) + rounding * normal);
    }
  }
  const unsigned south = meridians * rings;
  const unsigned north = south + 1;
  mesh.vertices.emplace_back(0, 0, -half_axes.z() - rounding);
  mesh.vertices.emplace_back(0, 0, half_axes.z() + rounding);
  for (unsigned k = 0; k < meridians; ++k) {
    const unsigned next = (k + 1) % meridians;
    mesh.triangles.push_back({south, next, k});
    for (unsigned low = 0; low + meridians < south; low += meridians) {
      const unsigned high = low + meridians;
      mesh.triangles.push_back({low + k, low + next, high + next});
      mesh.triangles.push_back({low + k, high + next, high + k});
    }
    mesh.triangles.push_back({north, south - meridians + k, south - meridians + next});
  }
  return mesh;
}

Polyhedron icosahedron(double radius) {
  Polyhedron mesh;
  const double golden = std::numbers::phi;
  for (const double one : {-1.0, 1.0}) {
    for (const double other : {-golden, golden}) {
      mesh.vertices.emplace_back(0, one, other);
      mesh.vertices.emplace_back(one, other, 0);
      mesh.vertices.emplace_back(other, 0, one);
    }
  }
  // Edges have length 2. Three vertices at this distance from each other form a face.
  const auto is_edge = [&](unsigned i, unsigned j) { return (mesh.vertices[i] - mesh.vertices[j]).norm() < 2.1; };
  const auto count = static_cast<unsigned>(mesh.vertices.size());
  for (unsigned i = 0; i < count; ++i) {
    for (unsigned j = i + 1; j < count; ++j) {
      for (unsigned k = j + 1; k < count; ++k) {
        if (!is_edge(i, j) || !is_edge(j, k) || !is_edge(i, k)) continue;
        const bool is_outward = mesh.vertices[i].dot(mesh.vertices[j].cross(mesh.vertices[k])) > 0;
        mesh.triangles.push_back(is_outward ? std::array{i, j, k} : std::array{i, k, j});
      }
    }
  }
  for (Vector3& vertex : mesh.vertices) vertex *= radius / vertex.norm();
  return mesh;
}

Polyhedron terrain(unsigned cells, double cell, double amplitude) {
  Polyhedron mesh;
  const double half = 0.5 * cells * cell;
  for (unsigned i = 0; i <= cells; ++i) {
    for (unsigned j = 0; j <= cells; ++j) {
      mesh.vertices.emplace_back(i * cell - half, j * cell - half, amplitude * std::sin(i) * std::sin(j));
    }
  }
  for (unsigned i = 0; i < cells; ++i) {
    for (unsigned j = 0; j < cells; ++j) {
      const unsigned corner = i * (cells + 1) + j;
      const unsigned across = corner + cells + 1;
      mesh.triangles.push_back({corner, across, across + 1});
      mesh.triangles.push_back({corner, across + 1, corner + 1});
    }
  }
  return mesh;
}

}  // namespace common
