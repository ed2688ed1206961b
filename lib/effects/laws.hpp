// Each effect's name, texts, rows and ranges of parameters, in one place. Refuses effects: the message names the effect, the
// parameter, its value and the valid range.
#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include "supernormal/effects.hpp"

namespace supernormal::effects {

/// Throws BadEffect (a std::invalid_argument) for the first parameter out of its range, for an effect that is listed twice, and for
/// an effect whose required partner is missing or that excludes another.
void require_valid(const std::vector<Effect>& list);

template <typename Wanted>
bool has(const std::vector<Effect>& list) {
  return std::ranges::any_of(list, [](const Effect& effect) { return std::holds_alternative<Wanted>(effect); });
}

}  // namespace supernormal::effects
