// Bounces within a step of ODE, of bodies that do not touch yet.
#pragma once

#include <ode/ode.h>

#include <optional>

namespace supernormal::ode {

/// Where two points touch that move apart with a velocity and a constant acceleration.
struct Touch {
  double time;   ///< s
  double speed;  ///< m/s; the approach velocity there
};

/// `gap`: m. `velocity`: of separation, as ODE has it at the start of a step of `step` s, m/s. `acceleration`: m/s^2. ODE adds
/// forces to velocities and then moves bodies with the new velocities. So its steps lie on a parabola that starts with velocity +
/// acceleration step / 2. Empty if they do not touch within the step.
std::optional<Touch> find_touch(double gap, double velocity, double acceleration, double step);

/// Whether bodies bounce that touch with `speed` (m/s). `load`: m/s^2; the larger acceleration of both, which contacts with other
/// bodies may hold up. A body at rest has an acceleration, but gains no speed by it.
bool is_impact(double speed, double restitution, double load, double step);

/// Lets a contact with depth < 0 close its gap within the step, and no more. If its surface has a restitution, the bodies bounce
/// instead if they would touch within the step; also those that touch already. The velocities and accelerations are those of the
/// bodies of its geoms. Throws std::invalid_argument if a parameter is out of range.
void let_close_or_bounce(dContact& contact, double step);

}  // namespace supernormal::ode
