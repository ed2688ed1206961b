// Refusal of effects: the message names the effect, the parameter, its value and the valid range.
#pragma once

#include <vector>

#include "supernormal/effects.hpp"

namespace supernormal::effects {

/// Throws std::invalid_argument for the first parameter out of its range, or for an effect that is listed twice or lacks another.
void require_valid(const std::vector<Effect>& list);

}  // namespace supernormal::effects
