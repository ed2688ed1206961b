// Polyhedra for dConvex and dTriMesh.
#pragma once

#include <array>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace common {

struct Polyhedron {
  std::vector<supernormal::Vector3> vertices;      ///< m
  std::vector<std::array<unsigned, 3>> triangles;  ///< counter-clockwise from outside
};

/// The resolution of a mesh: the numbers of meridians and of rings between the poles.
struct MeshSize {
  unsigned meridians, rings;

  unsigned vertices() const { return meridians * rings + 2; }
  unsigned triangles() const { return 2 * meridians * rings; }
};

/// The mesh of a superellipsoid swept by a sphere of radius `rounding` (m). The vertices are on its boundary.
Polyhedron superellipsoid_mesh(const supernormal::Vector3& half_axes, double delta, double epsilon, double rounding, MeshSize size);

Polyhedron icosahedron(double radius);

/// A mesh of cells x cells squares of two triangles each about the origin, shaped like an egg carton. Heights are along z, up to
/// `amplitude`.
Polyhedron terrain(unsigned cells, double cell, double amplitude);

}  // namespace common
