// The range of solver settings, for all that take them: queries, the C interface and Python.
#pragma once

#include <stdexcept>
#include <string>

#include "base/validation.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// Returns the settings. Throws std::invalid_argument with the first of them that is out of range.
inline const Settings& require_in_range(const Settings& settings) {
  constexpr int kMostEvaluations = 1000000;
  require_in("tolerance", settings.tolerance, 1e-15, 1);
  if (settings.max_evaluations >= 1 && settings.max_evaluations <= kMostEvaluations) return settings;
  throw std::invalid_argument("max_evaluations = " + std::to_string(settings.max_evaluations) + " is outside [1, " +
                              std::to_string(kMostEvaluations) + "]");
}

}  // namespace supernormal
