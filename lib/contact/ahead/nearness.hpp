// Which bodies are near enough to be brought together, and how two share in their motion.
#pragma once

#include <algorithm>
#include <cmath>

#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal {

// A push of the same step may bring bodies together that are no farther apart than this share of the smaller one's half-extent.
inline constexpr double kSlack = 0.01;

// radians; what comes down by a larger turn may be any side of the body.
inline constexpr double kLargestTilt = 0.5;

/// How far rotation carries a point of the body within `time`, m: no farther than to the other side.
inline double turn_of(const MotionAhead& motion, double time) {
  return motion.arm * std::min(2.0, motion.angular_velocity.norm() * time);
}

/// How much nearer than their velocities say two bodies may come within `time`, m.
inline double nearness_of_both(const MotionAhead& motion1, const MotionAhead& motion2, double time, double size) {
  const double acceleration = std::max(motion1.acceleration, motion2.acceleration);
  return turn_of(motion1, time) + turn_of(motion2, time) + acceleration * time * time + kSlack * size;
}

/// How much nearer than their gap two bodies would come within `time` if nothing held them, along the unit normal from the first to
/// the second, m; negative: they stay apart.
inline double approach_of(const MotionAhead& motion1, const MotionAhead& motion2, double time, const Vector3& normal, double gap) {
  const double gained = time * std::max(motion1.acceleration, motion2.acceleration);
  return (normal.dot(motion1.velocity - motion2.velocity) + gained) * time - gap;
}

/// The tilt of the corners that the bodies may come down on within `time`, radians: what stops an `approach` (m) at one end of a
/// body of the half-extent `size` (m) turns it by the ratio of both, beside the turn in which the bodies are.
inline double tilt_ahead(const MotionAhead& motion1, const MotionAhead& motion2, double time, double approach, double size) {
  const double turn = (motion1.angular_velocity.norm() + motion2.angular_velocity.norm()) * time + std::max(0.0, approach) / size;
  return std::clamp(turn, kLeastTilt, kLargestTilt);
}

inline bool is_finite(const MotionAhead& motion) {
  return motion.velocity.allFinite() && motion.centre.allFinite() && motion.turning.allFinite() &&
         motion.angular_velocity.allFinite() && std::isfinite(motion.arm) && std::isfinite(motion.acceleration) &&
         std::isfinite(motion.mobility);
}

/// The share of body 1 in the motion of both.
inline double share_of_first(const MotionAhead& motion1, const MotionAhead& motion2) {
  const double sum = motion1.mobility + motion2.mobility;
  return sum > 0 ? motion1.mobility / sum : 0.5;
}

}  // namespace supernormal
