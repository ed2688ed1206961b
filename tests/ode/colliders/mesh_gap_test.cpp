// Tests that snGeomProximity and dCollide agree on the gap of a body and a mesh with concave parts.
#include <doctest/doctest.h>

#include <numbers>

#include "ode/mesh_fixture.hpp"
#include "support/draw.hpp"

using namespace supernormal::test;

namespace {

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

const std::array<MeshArrays, 3>& hollow_meshes() {
  static const std::array<MeshArrays, 3> meshes = {ring_arrays(1, 0.4, 12, 8), ring_arrays(1, 0.3, 40, 20), step_arrays()};
  return meshes;
}

}  // namespace

TEST_CASE(
    "the gap of a body and a mesh with hollows is minus the depth of the deepest contact, and a gap that is not positive has a "
    "contact") {
  OdeSession session;
  Random random(82);
  std::size_t contact_count = 0;
  for (const MeshArrays& arrays : hollow_meshes()) {
    const MeshGeom mesh(arrays);
    for (int i = 0; i < draws(1000); ++i) {
      CAPTURE(i);
      const auto half_axis = [&] { return dReal(random.uniform(0.1, 0.6)); };
      const auto exponent = [&] { return dReal(1 + 0.02 * std::pow(1e4, random.uniform(0, 1))); };
      const std::array<dReal, 5> size = {half_axis(), half_axis(), half_axis(), exponent(), exponent()};
      const Geom body(snCreateSuperellipsoid(nullptr, size[0], size[1], size[2], size[3], size[4]));
      place(body, random.uniform(0.2, 2) * random.direction());
      random.turn(body);
      const auto contacts = collide(body, mesh, 64);
      const snProximity one = proximity_of(body, mesh), other = proximity_of(mesh, body);
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
  CHECK(contact_count > draws(750));
}
