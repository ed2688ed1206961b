// Formats numbers.
#pragma once

#include <string>

namespace common {

/// Formats a number for readable tables, by printf with a format of one double. "–" for NaN.
std::string text(const char* format, double value);

/// Formats a number for CSV with six digits.
std::string number(double value);

}  // namespace common
