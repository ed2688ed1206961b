// A body and a plane: the one pair that needs no iteration.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The proximity of a body and the half-space plane_normal . x <= plane_offset, in the world frame; plane_normal of unit length,
/// pointing out of the half-space, plane_offset in m. The body's point nearest to the plane, or deepest below it, is the one with
/// normal -plane_normal: explicit, exact, without an evaluation of a gap function. It is also the contact point, as with ODE's
/// own colliders with planes. Status::Converged, or InvalidInput when a number is not finite, the rotation is none (Pose), or the
/// body is farther than 1e150 m from the origin.
SUPERNORMAL_API Proximity find_plane_proximity(const Shape& shape, const Pose& pose, const Vector3& plane_normal,
                                               double plane_offset);

}  // namespace supernormal
