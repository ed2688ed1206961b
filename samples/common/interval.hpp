// Ranges of numbers for input checks.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

namespace common {

constexpr double kLargestLength = 1000;  ///< m; a longer length in a scene is a typing error
constexpr double kLargestSpeed = 1000;   ///< m/s

/// A range of real numbers. No range contains infinity or NaN, whatever its bounds.
struct Interval {
  double lower;
  double upper;
  bool includes_lower;
  bool includes_upper;
  const char* unit;  ///< "" for pure numbers

  static Interval positive(double upper, const char* unit) { return {0, upper, false, true, unit}; }
  /// Contains any finite number; `note` says what a later check allows.
  static Interval finite(const char* note) {
    return {-std::numeric_limits<double>::max(), std::numeric_limits<double>::max(), true, true, note};
  }
  static Interval closed(double lower, double upper, const char* unit) { return {lower, upper, true, true, unit}; }

  bool contains(double value) const;
  std::string describe() const;  ///< "a number in (0, 1] m"
};

/// The shortest text that reads back as the same number.
std::string shortest(double value);

/// The number as text, with three significant digits, or as many as are asked for.
std::string rounded(double value, int digits = 3);

/// The least number of six significant digits that is not below `value`: a computed bound, which an input may have as it is read.
std::string rounded_up(double value);

/// "1 grain", "2 grains".
std::string counted(std::size_t number, const std::string& noun);

}  // namespace common
