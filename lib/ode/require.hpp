// Refusals that the C interface adds to those of the core.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "shapes/validation.hpp"

namespace supernormal::ode {

inline void require_not_null(const char* name, const void* pointer) {
  if (pointer == nullptr) throw std::invalid_argument(std::string(name) + " = NULL, but must point to something");
}

/// Infinity and NaN are outside.
inline double require_positive(const char* name, double value, const char* unit) {
  if (value > 0 && std::isfinite(value)) return value;
  throw std::invalid_argument(std::string(name) + " = " + to_text(value) + " " + unit + " is outside (0, inf) " + unit);
}

inline Vector3 require_finite(const char* name, const Vector3& value) {
  if (value.allFinite()) return value;
  throw std::invalid_argument(std::string(name) + " = (" + to_text(value.x()) + ", " + to_text(value.y()) + ", " +
                              to_text(value.z()) + ") is not finite");
}

}  // namespace supernormal::ode
