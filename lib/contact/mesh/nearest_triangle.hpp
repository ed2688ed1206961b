// The distance of a body from a surface.
#pragma once

#include <span>

#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The proximity, in the world frame, of the body and the triangle with the smallest gap, all taken as two-sided. Degenerate
/// triangles count as the segment or point that they are; those with a coordinate that is not finite or beyond 1e30 are skipped.
/// Status::InvalidInput when none is left. Proximity::evaluations counts those of all triangles that were tried: most are ruled
/// out by the supporting planes of the body at the nearest one found so far.
MeshContact find_nearest_triangle(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles,
                                  const Settings& settings);

}  // namespace supernormal
