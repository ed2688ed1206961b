// Each effect's name, texts, rows and ranges of parameters, in one place.
#pragma once

#include "supernormal/effects.hpp"

namespace supernormal::effects {

/// Throws BadEffect (a std::invalid_argument) for the first parameter out of its range. The message names the effect, the
/// parameter, its value and the range.
void require_parameters(const Effect& effect);

}  // namespace supernormal::effects
