// Refuses parameters: the message names the parameter, its value and the valid range.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "base/finite.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

// Within these lengths every quantity of a shape is a normal number, up to the fifth power in the second moments.
constexpr double kMinLength = 1e-30;  // m
constexpr double kMaxLength = 1e30;   // m

// Precision asked of callbacks, relative to the size: about 10 ulps of single precision. Of 20 000 ellipsoids and superellipsoids
// computed in single precision (exponents 1.05 to 20) it refuses one, of exponent 1.05; 1e-7 would refuse a third.
constexpr double kCallbackPrecision = 1e-6;

/// The shortest decimal text that reads back as the same double.
inline std::string to_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

/// Returns `value` if low <= value <= high. Otherwise throws std::invalid_argument, such as "radius = -1 m is outside [0, 1e+30]
/// m". A NaN is outside, and raises no floating-point exception, which the operator >= would. `unit` is "" for a dimensionless
/// value.
inline double require_in(const char* name, double value, double low, double high, const char* unit = "") {
  if (std::isgreaterequal(value, low) && std::islessequal(value, high)) return value;
  const std::string tail = *unit == '\0' ? std::string() : std::string(" ") + unit;
  throw std::invalid_argument(std::string(name) + " = " + to_text(value) + tail + " is outside [" + to_text(low) + ", " +
                              to_text(high) + "]" + tail);
}

/// Throws std::invalid_argument if a direction has not unit length, to 1e-6. Directions that are not finite pass: queries return a
/// status for them.
inline void require_unit(const char* name, const Vector3& direction) {
  // The range is tested first, because squares out of range would raise floating-point exceptions.
  if (all_within(direction, 2) && std::abs(direction.norm() - 1) <= 1e-6) return;
  if (all_finite(direction)) require_in((std::string("length of ") + name).c_str(), direction.stableNorm(), 1 - 1e-6, 1 + 1e-6);
}

/// Throws std::invalid_argument if an array of answers has another length than the queries.
inline void require_one_for_each(const char* name, std::size_t length, std::size_t queries) {
  if (length == queries) return;
  throw std::invalid_argument(std::string(name) + " has " + std::to_string(length) + " elements, and there are " +
                              std::to_string(queries) + " queries");
}

/// Returns the half-axes a, b, c in m. Throws std::invalid_argument with the name of the first one outside [kMinLength,
/// kMaxLength].
inline Vector3 require_half_axes(const Vector3& half_axes) {
  const char* const names[] = {"half-axis a", "half-axis b", "half-axis c"};
  for (int axis = 0; axis < 3; ++axis) require_in(names[axis], half_axes[axis], kMinLength, kMaxLength, "m");
  return half_axes;
}

/// Throws std::domain_error if the volume of `what` is not known to 1 %. Quadrature samples normals, and those of faces and edges
/// have measure zero, so their volume may be missing.
inline void require_known(const MassProperties& mass, const std::string& what) {
  constexpr double kMaxRelativeError = 0.01;
  if (!(mass.relative_error > kMaxRelativeError)) return;
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, "%.3g m^3, is uncertain by %.2g %%", mass.volume, 100 * mass.relative_error);
  throw std::domain_error("the volume of " + what + ", " + numbers + ", but must be known to 1 %");
}

}  // namespace supernormal
