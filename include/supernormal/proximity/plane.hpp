// A body and a plane: the one pair that needs no iteration.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The proximity of a body and the half-space plane_normal . x <= plane_offset, in the world frame. plane_normal has unit length,
/// to 1e-6, and points out of the half-space; plane_offset is in m. The body's point nearest to the plane, or deepest below it, is
/// the boundary point with the normal -plane_normal. So the result is explicit and exact, without an evaluation of a gap function.
/// This is also the contact point, as in ODE's own colliders with planes. Returns Status::Converged. Returns Status::InvalidInput
/// if a number is not finite, the matrix is not a rotation (Pose), or the body is farther than 1e150 m from the origin. Throws
/// std::invalid_argument if plane_normal has another length.
SUPERNORMAL_API Proximity find_plane_proximity(const Shape& shape, const Pose& pose, const Vector3& plane_normal,
                                               double plane_offset);

}  // namespace supernormal
