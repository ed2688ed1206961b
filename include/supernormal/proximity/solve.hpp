// Proximity queries of two bodies.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The gap, common normal and witness points of two bodies, in the world frame.
///
/// `first_normal` (unit, in body 1's frame, or null) is where the solver starts: the normal of an earlier, similar pose of the two
/// bodies. It is only a guess: for bodies apart or touching every start leads to the same answer. Overlapping bodies may have
/// several local maxima. With `first_normal` the hybrid follows the maximum to which it leads, so that a contact is continuous in
/// time. Without it, the hybrid looks for the highest maximum. With Settings::certify_depth it finds the highest maximum in either
/// case.
///
/// Returns Status::InvalidInput if a pose or a value from a shape is not finite, a matrix is not a rotation (Pose), or a position
/// is farther than 1e150 m from the origin. Throws std::invalid_argument if the settings are out of range.
SUPERNORMAL_API Proximity find_proximity(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                         const Settings& settings = {}, const Vector3* first_normal = nullptr);

}  // namespace supernormal
