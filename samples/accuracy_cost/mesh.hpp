// Polyhedra for ODE's dConvex and dTriMesh.
#pragma once

#include <array>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace accuracy_cost {

struct Mesh {
  std::vector<supernormal::Vector3> vertices;      ///< m
  std::vector<std::array<unsigned, 3>> triangles;  ///< counter-clockwise from outside
};

/// A superellipsoid with both exponents equal, by meridians and the rings between its two poles: 2 meridians rings triangles.
Mesh superellipsoid_mesh(const supernormal::Vector3& half_axes, double exponent, unsigned meridians, unsigned rings);

Mesh icosahedron(double radius);

/// cells x cells squares of two triangles each, around the origin; heights along z, up to `amplitude`, like an egg carton.
Mesh terrain(unsigned cells, double cell, double amplitude);

}  // namespace accuracy_cost
