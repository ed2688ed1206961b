// A closed mesh of a convex body, from its normals.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "supernormal/export.h"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Triangles between boundary points of a body, counter-clockwise seen from outside.
struct Tessellation {
  std::vector<Vector3> points;                          ///< m, in the body's frame
  std::vector<Vector3> normals;                         ///< unit, outward; of the points
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< the vertices of each, as indices into points
};

/// A closed mesh of `shape`. Its vertices are on the boundary, and its edges are at most `chord_error` (m) away from it.
///
/// The vertices are r(n). The normals n start with the vertices of an octahedron. An edge is halved, at the normal between the
/// normals of its ends, as long as the boundary between them may be farther away than allowed. The boundary is below the tangent
/// planes of both ends. So with the angles a1 and a2 between these planes and an edge of length l, the distance is at most l / (cot
/// a1 + cot a2). Each edge decides by itself, so the triangles on both sides agree and the mesh stays closed. A flat face has
/// nearly one normal, and few triangles. A sharp edge has most normals, and the mesh follows it as it bends.
///
/// Throws std::invalid_argument if chord_error is not in [kLeastChordError times the body's largest half-extent, inf). At the lower
/// end a sphere has four million triangles. Throws std::domain_error if a point from the shape is not finite, or outside the ball
/// of the shape's bounding radius.
SUPERNORMAL_API Tessellation tessellate(const Shape& shape, double chord_error);

/// The smallest chord error, in units of the largest half-extent.
inline constexpr double kLeastChordError = 1e-6;

}  // namespace supernormal
