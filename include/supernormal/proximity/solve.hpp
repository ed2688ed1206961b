// Proximity queries of two bodies.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The gap, common normal and witness points of two bodies; the result is in the world frame.
///
/// `first_normal` (unit, in body 1's frame, or null) is where the solver starts: the normal of an earlier, similar pose of the
/// two bodies. It is only a guess: for bodies apart or touching every start leads to the same answer. Overlapping bodies may have
/// several local maxima; the hybrid then follows the one that `first_normal` leads to, so that a contact is continuous in time,
/// and without it looks for the highest. With Settings::certify_depth it finds the highest in either case.
///
/// Returns Status::InvalidInput when a pose or what a shape delivers is not finite, a rotation is none (Pose), or a position is
/// farther than 1e150 m from the origin; throws std::invalid_argument when the settings are out of range.
SUPERNORMAL_API Proximity find_proximity(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                         const Settings& settings = {}, const Vector3* first_normal = nullptr);

}  // namespace supernormal
