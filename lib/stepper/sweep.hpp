// What changes velocities: passes over all joints and contacts, each solved for itself (projected Gauss-Seidel), and restitution.
#pragma once

#include <array>

#include "stepper/contact.hpp"

namespace supernormal::stepper {

struct SweepSettings {
  /// A biased sweep comes before the positions and also takes a little of every overlap away. A relaxing sweep comes after them and
  /// takes the velocity of that away again.
  bool is_biased = true;
  bool is_backward = false;
  bool is_last = false;    ///< of the step
  double time = 0;         ///< s, of the sub-step
  double elapsed = 0;      ///< s, since the step began
  double fastest_out = 0;  ///< m/s; overlaps are corrected no faster
  Softness softness;       ///< of joints
};

/// Scales the impulses along two axes into the ellipse of their limits; one that has no limit leaves the other alone.
void limit_to_ellipse(std::array<double, 2>& impulses, const std::array<double, 2>& limits);

void sweep(System& system, const SweepSettings& settings);

/// Lets the pairs bounce that would meet in the next `time` (s), one after the other. A pair that has bounced may set others going,
/// which bounce in the next round. So Newton's cradle passes its momentum on, at any gap between its balls.
void bounce(System& system, double time);

}  // namespace supernormal::stepper
