// Steady motion of a body.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// m, m/s, rad/s and rad; an upper bound on the numbers of a Motion and on the angle of a rotation. Products of two such numbers
/// and a time are finite.
inline constexpr double kMaxMotion = 1e75;

/// A body that moves with constant linear and angular velocity. `centre` moves on a straight line, and the body rotates about a
/// fixed direction through it. A rigid body moves like this from one step to the next if `centre` is its centre of mass.
struct Motion {
  Pose pose;                                   ///< at time 0
  Vector3 velocity = Vector3::Zero();          ///< m/s; of `centre`
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s; in the frame that the pose refers to
  Vector3 centre = Vector3::Zero();            ///< m; in the body's frame: the centre of rotation, such as the centre of mass
};

/// The pose at `time` (s, of either sign): x = R p + position with R = exp(time [angular_velocity]) pose.rotation. The position is
/// such that `centre` is at its first place + time velocity. Numbers that are not finite give a pose that is not finite.
SUPERNORMAL_API Pose pose_at(const Motion& motion, double time);

}  // namespace supernormal
