// Tests for what a search for an impact can compute with.
#pragma once

#include "base/usable_pose.hpp"
#include "base/validation.hpp"
#include "proximity/gap/usable_settings.hpp"
#include "supernormal/impact/time_of_impact.hpp"

namespace supernormal {

/// Throws std::invalid_argument if a number is out of range.
inline void require_usable(double horizon, const Settings& settings) {
  require_in("horizon", horizon, 0, kMaxHorizon, "s");
  require_in_range(settings);
}

/// Whether the numbers of a motion, and the angle of its rotation until the horizon, are in range.
inline bool is_usable(const Motion& motion, double horizon) {
  const bool is_in_range = all_within(motion.velocity, kMaxMotion) && all_within(motion.angular_velocity, kMaxMotion) &&
                           all_within(motion.centre, kMaxMotion) && all_within(motion.pose.position, kMaxMotion);
  return is_in_range && is_usable(motion.pose) && all_within(horizon * motion.angular_velocity, kMaxMotion);
}

}  // namespace supernormal
