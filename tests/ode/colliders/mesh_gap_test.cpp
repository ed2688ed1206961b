// Tests that snGeomProximity and dCollide agree on the gap of a body and a mesh with concave parts. For balls both agree with the
// distance of their centre.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "ode/mesh_fixture.hpp"
#include "support/draw.hpp"

using namespace supernormal::test;

namespace {

Vec cross(const Vec& a, const Vec& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }

/// A closed ring of flat faces: convex outside, with saddles inside.
MeshArrays ring_arrays(double ring_radius, double tube_radius, unsigned around, unsigned about) {
  MeshArrays mesh;
  for (unsigned i = 0; i < around; ++i) {
    for (unsigned j = 0; j < about; ++j) {
      const double u = 2 * std::numbers::pi * i / around;
      const double v = 2 * std::numbers::pi * j / about;
      const double r = ring_radius + tube_radius * std::cos(v);
      mesh.add(r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v));
    }
  }
  for (unsigned i = 0; i < around; ++i) {
    for (unsigned j = 0; j < about; ++j) {
      const auto at = [&](unsigned k, unsigned l) { return (k % around) * about + l % about; };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// A closed block with a step in its top, 2 x 1 x 1 without a quarter. It has convex and concave edges.
MeshArrays step_arrays() {
  MeshArrays mesh;
  const std::array<std::array<double, 2>, 6> outline = {{{-1, -0.5}, {1, -0.5}, {1, 0}, {0, 0}, {0, 0.5}, {-1, 0.5}}};
  for (const double y : {-0.5, 0.5}) {
    for (const auto& [x, z] : outline) mesh.add(x, y, z);
  }
  for (unsigned k = 0; k < 6; ++k) {
    const unsigned next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, next + 6});
    mesh.triangles.push_back({k, next + 6, k + 6});
  }
  // Each side consists of two convex pieces.
  const std::array<std::array<unsigned, 3>, 4> side = {{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
  for (const auto& [a, b, c] : side) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  return mesh;
}

std::array<Vec, 3> corners_of(const MeshArrays& mesh, std::size_t index) {
  std::array<Vec, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& v = mesh.vertices[mesh.triangles[index][k]];
    corners[k] = {double{v[0]}, double{v[1]}, double{v[2]}};
  }
  return corners;
}

/// The distance of the point from the triangle: over the face, or else from the nearest side.
double distance_from(const std::array<Vec, 3>& t, const Vec& p) {
  const Vec normal = cross(t[1] - t[0], t[2] - t[0]);
  bool is_over = true;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec edge = t[(k + 1) % 3] - t[k];
    const Vec from_start = p - t[k];
    is_over = is_over && dot(cross(normal, edge), from_start) >= 0;
    const double share = std::clamp(dot(edge, from_start) / dot(edge, edge), 0.0, 1.0);
    least = std::min(least, norm(from_start - share * edge));
  }
  return is_over ? std::abs(dot(normal, p - t[0])) / norm(normal) : least;
}

double distance_from(const MeshArrays& mesh, const Vec& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) least = std::min(least, distance_from(corners_of(mesh, i), p));
  return least;
}

/// Whether a point is inside, by the solid angle of the mesh (van Oosterom, Strackee: The solid angle of a plane triangle, IEEE
/// Trans. Biomed. Eng. 30, 1983).
bool is_within(const MeshArrays& mesh, const Vec& p) {
  double angle = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<Vec, 3> t = corners_of(mesh, i);
    for (Vec& corner : t) corner = corner - p;
    const double a = norm(t[0]);
    const double b = norm(t[1]);
    const double c = norm(t[2]);
    angle +=
        2 * std::atan2(dot(t[0], cross(t[1], t[2])), a * b * c + dot(t[0], t[1]) * c + dot(t[0], t[2]) * b + dot(t[1], t[2]) * a);
  }
  return angle > 2 * std::numbers::pi;
}

const std::array<MeshArrays, 3>& hollow_meshes() {
  static const std::array<MeshArrays, 3> meshes = {ring_arrays(1, 0.4, 12, 8), ring_arrays(1, 0.3, 40, 20), step_arrays()};
  return meshes;
}

}  // namespace

TEST_CASE("the gap of a ball and a mesh with hollows is the distance of its centre less the radius") {
  OdeSession session;
  Random random(81);
  for (const MeshArrays& arrays : hollow_meshes()) {
    const MeshGeom mesh(arrays);
    int touching = 0;
    for (int i = 0; i < draws(2000); ++i) {
      CAPTURE(i);
      const double radius = random.uniform(0.05, 0.5);
      const Geom ball(snCreateEllipsoid(nullptr, dReal(radius), dReal(radius), dReal(radius)));
      const Vec where = random.uniform(0.2, 2) * random.direction();
      if (is_within(arrays, where)) continue;
      place(ball, where);
      random.turn(ball);
      const double gap = distance_from(arrays, where) - radius;
      const auto contacts = collide(ball, mesh, 64);
      snProximity proximity;
      REQUIRE(snGeomProximity(ball, mesh, &proximity) == 1);
      if (std::abs(gap) < 1e-9) continue;
      CHECK(contacts.empty() == (gap > 0));
      if (gap < -0.1 * radius)
        continue;  // in a deeper overlap, the planes on both sides of a concave edge extend beyond their faces
      CHECK(std::abs(proximity.gap - gap) < within_rounding(1e-9) * radius);
      if (gap < 0) ++touching;
    }
    CHECK(touching > draws(28));
  }
}

TEST_CASE(
    "the gap of a body and a mesh with hollows is minus the depth of the deepest contact, and a gap that is not positive has a "
    "contact") {
  OdeSession session;
  Random random(82);
  std::size_t contact_count = 0;
  for (const MeshArrays& arrays : hollow_meshes()) {
    const MeshGeom mesh(arrays);
    for (int i = 0; i < draws(2000); ++i) {
      CAPTURE(i);
      const auto half_axis = [&] { return dReal(random.uniform(0.1, 0.6)); };
      const auto exponent = [&] { return dReal(1 + 0.02 * std::pow(1e4, random.uniform(0, 1))); };
      const std::array<dReal, 5> size = {half_axis(), half_axis(), half_axis(), exponent(), exponent()};
      const Geom body(snCreateSuperellipsoid(nullptr, size[0], size[1], size[2], size[3], size[4]));
      place(body, random.uniform(0.2, 2) * random.direction());
      random.turn(body);
      const auto contacts = collide(body, mesh, 64);
      snProximity one;
      snProximity other;
      REQUIRE(snGeomProximity(body, mesh, &one) == 1);
      REQUIRE(snGeomProximity(mesh, body, &other) == 1);
      CHECK(one.gap == other.gap);
      CHECK(to_vec(one.normal) == -1.0 * to_vec(other.normal));
      contact_count += contacts.size();
      if (std::abs(one.gap) > 1e-9) CHECK(contacts.empty() == (one.gap > 0));
      if (contacts.empty()) continue;
      CHECK(double{contacts[0].depth} == -one.gap);
      CHECK(norm(to_vec(contacts[0].normal) + to_vec(one.normal)) < 1e-15);
      for (const dContactGeom& contact : contacts) CHECK(contact.depth <= contacts[0].depth);
    }
  }
  CHECK(contact_count > draws(1500));
}
