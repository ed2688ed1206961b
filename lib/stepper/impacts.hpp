// Restitution.
#pragma once

#include "stepper/contact.hpp"

namespace supernormal::stepper {

/// Lets the pairs bounce that would meet in the next `time` (s), one after the other. A pair that has bounced may set others going,
/// which bounce in the next round. So Newton's cradle passes its momentum on, at any gap between its balls.
void bounce(System& system, double time);

}  // namespace supernormal::stepper
