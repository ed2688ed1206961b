// Steady motion of a body.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// m, m/s, rad/s and rad; no number of a Motion and no angle that a body turns may be larger: products of two such numbers and a
/// time are finite.
inline constexpr double kMaxMotion = 1e75;

/// A body that moves with constant linear and angular velocity: `centre` goes straight on, and the body turns about an axis through
/// it that keeps its direction. So a rigid body moves from one step to the next, with its centre of mass as `centre`.
struct Motion {
  Pose pose;                                   ///< at time 0
  Vector3 velocity = Vector3::Zero();          ///< m/s; of `centre`
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s; in the frame that the pose refers to
  Vector3 centre = Vector3::Zero();            ///< m; in the body's frame: what it turns about, such as its centre of mass
};

/// The pose at `time` (s, of either sign): x = R p + position with R = exp(time [angular_velocity]) pose.rotation, and the position
/// such that `centre` is at its first place + time velocity. Numbers that are not finite come out as such.
SUPERNORMAL_API Pose pose_at(const Motion& motion, double time);

}  // namespace supernormal
