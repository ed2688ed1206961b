// How contacts that overlap give way: a spring and a damper, integrated implicitly, so what a sweep has not solved cannot ring.
#pragma once

#include "stepper/contact.hpp"

namespace supernormal::stepper {

// rad; the phase of a contact's spring in a sub-step. With half of it loads press in four times as far, with twice as much they are
// thrown (README).
inline constexpr double kPhase = 0.4 * 3.14159265358979323846;

// The damping ratio of a contact's spring: an overlap is corrected in some 20 sub-steps, and nothing swings (README).
inline constexpr double kDampingRatio = 10;

// Relative to the size: a deeper overlap is corrected no faster than this one, or bodies that a program puts into one another are
// thrown apart (README).
inline constexpr double kDeep = 0.1;

/// Of a contact in a sub-step of `time` (s), with a spring that turns by kPhase in `spring` (s).
inline Softness softness_in(double time, double spring) {
  const double phase = kPhase * time / spring;
  const double damping = phase * (2 * kDampingRatio + phase);
  return {phase / (2 * kDampingRatio + phase) / time, damping / (1 + damping), 1 / (1 + damping), kDeep};
}

/// Of a contact with quickstep's ERP and CFM, m/(N s), in sub-steps of `time` of a `step` (s). It is the spring and the damper that
/// these two numbers are to quickstep.
inline Softness softness_of(double erp, double cfm, double mobility, double step, double time) {
  if (cfm == 0) return {erp / step, 1, 0, kAny};
  const double spring = erp / (step * cfm);  // N/m
  const double damper = (1 - erp) / cfm;     // N s/m
  const double resistance = time * spring + damper;
  const double compliance = 1 / (time * resistance);  // 1/kg
  return {spring / resistance, mobility / (mobility + compliance), compliance / (mobility + compliance), kAny};
}

}  // namespace supernormal::stepper
