// Argument checks that the C interface adds to the checks of the core.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/usable_pose.hpp"
#include "base/validation.hpp"

namespace supernormal::ode {

inline void require_not_null(const char* name, const void* pointer) {
  if (pointer == nullptr) throw std::invalid_argument(std::string(name) + " = NULL, but must point to something");
}

/// Refuses any value that is not positive and finite, NaN included.
inline double require_positive(const char* name, double value, const char* unit) {
  if (value > 0 && std::isfinite(value)) return value;
  throw std::invalid_argument(std::string(name) + " = " + to_text(value) + " " + unit + " is outside (0, inf) " + unit);
}

inline Vector3 require_finite(const char* name, const Vector3& value) {
  if (value.allFinite()) return value;
  throw std::invalid_argument(std::string(name) + " = (" + to_text(value.x()) + ", " + to_text(value.y()) + ", " +
                              to_text(value.z()) + ") is not finite");
}

/// Refuses a point (m) outside the valid range. The message names the coordinate and the range.
inline Vector3 require_place(const Vector3& point) {
  const char* const names[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) require_in(names[axis], point[axis], -kFarthest, kFarthest, "m");
  return point;
}

/// The rest of a message after the word "pose", for queries that the core refuses.
inline std::string no_answer_because() {
  return ", or what a user-defined body returned, is not finite, or a position is not within " + to_text(kFarthest) + " m";
}

}  // namespace supernormal::ode
