// A closed mesh of a smooth convex body, through its normals.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "supernormal/export.h"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Triangles whose corners are boundary points of a body, anticlockwise as seen from outside.
struct Tessellation {
  std::vector<Vector3> points;                          ///< m, in the body's frame
  std::vector<Vector3> normals;                         ///< unit, outward; of the points
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< corners of each, numbers of points
};

/// A mesh of `shape` whose edges are no farther than `chord_error` (m) from the boundary; its corners are on the boundary, and it
/// is closed.
///
/// The corners are r(n) for normals n that start as those of an octahedron. An edge is halved, at the normal between those of its
/// ends, as long as the boundary between them may be farther away than allowed: it lies below the tangent planes of both ends, so
/// that with the angles a1 and a2 of these to an edge of length l the distance is at most l / (cot a1 + cot a2). An edge decides by
/// itself, so that the triangles on both sides agree and the mesh stays closed. A flat face, whose normals hardly differ, is
/// spanned by few triangles, and a sharp edge, which holds most normals, is followed as it bends.
///
/// Throws std::invalid_argument when chord_error is not in [kLeastChordError times the body's largest half-extent, inf): a sphere
/// then has four million triangles.
SUPERNORMAL_API Tessellation tessellate(const Shape& shape, double chord_error);

/// The smallest chord error, in units of the largest half-extent.
inline constexpr double kLeastChordError = 1e-6;

}  // namespace supernormal
