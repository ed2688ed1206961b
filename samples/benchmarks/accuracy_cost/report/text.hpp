// Numbers as text.
#pragma once

#include <string>

namespace accuracy_cost {

/// Formats a number for tables that people read, by printf with a format of one double; "–" when there is none (NaN).
std::string text(const char* format, double value);

/// Formats a number for CSV, to six digits.
std::string number(double value);

}  // namespace accuracy_cost
