// What a contact's surface asks for: dSurfaceParameters, tested and without flags.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cmath>

namespace supernormal::stepper {

/// A largest force or torque: a multiple of the normal force, or a constant.
struct Limit {
  double value = 0;  ///< dimensionless or m; N or N m
  bool is_of_normal = false;

  /// N s or N m s; in `time` (s), with a normal impulse (N s). 0 without one: what is apart does not rub.
  double in(double time, double normal_impulse) const {
    return normal_impulse > 0 ? value * (is_of_normal ? normal_impulse : time) : 0;
  }

  /// N s or N m s; in no time, in which a force has no impulse.
  double of_impact(double normal_impulse) const { return is_of_normal || std::isinf(value) ? value * normal_impulse : 0; }
};

struct Surface {
  std::array<Limit, 2> friction;   ///< along the two directions across the normal
  std::array<Limit, 3> rolling;    ///< about these directions and about the normal
  std::array<double, 3> motion{};  ///< m/s; along the normal, and across it
  std::array<double, 2> slip{};    ///< m/(N s)
  double bounce = 0;               ///< separating velocity over approach velocity
  double bounce_speed = 0;         ///< m/s; slower impacts do not bounce
  double erp = -1;                 ///< of quickstep's contact; negative: not chosen
  double cfm = -1;                 ///< 1/(N s/m); negative: not chosen
  bool has_direction = false;      ///< whether fdir1 is the first direction

  bool slips() const { return slip[0] > 0 || slip[1] > 0; }
  bool rolls() const { return rolling[0].value > 0 || rolling[1].value > 0 || rolling[2].value > 0; }
};

/// Throws std::invalid_argument if a number is out of range. The message names it.
Surface surface_of(const dContact& contact);

}  // namespace supernormal::stepper
