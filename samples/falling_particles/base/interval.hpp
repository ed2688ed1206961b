// Ranges of numbers for input checks.
#pragma once

#include <limits>
#include <string>

namespace falling_particles {

constexpr double kLargestLength = 1000;  ///< m; what is longer in a scene is a slip
constexpr double kLargestSpeed = 1000;   ///< m/s

/// A range of real numbers. No bound, open or closed, ever admits infinity or NaN.
struct Interval {
  double lower;
  double upper;
  bool includes_lower;
  bool includes_upper;
  const char* unit;  ///< "" for pure numbers

  static Interval positive(double upper, const char* unit) { return {0, upper, false, true, unit}; }
  /// Admits any finite number; `note` tells what a later check will allow.
  static Interval finite(const char* note) {
    return {-std::numeric_limits<double>::max(), std::numeric_limits<double>::max(), true, true, note};
  }
  static Interval closed(double lower, double upper, const char* unit) { return {lower, upper, true, true, unit}; }

  bool contains(double value) const;
  std::string describe() const;  ///< "a number in (0, 1] m"
};

/// Shortest text that reads back as the same number.
std::string shortest(double value);

/// With three digits.
std::string rounded(double value);

}  // namespace falling_particles
