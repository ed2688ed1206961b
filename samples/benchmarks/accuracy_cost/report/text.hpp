// Numbers as text.
#pragma once

#include <string>

namespace accuracy_cost {

/// For tables to be looked at: as printf writes it with a format of one double; "–" when there is none (NaN).
std::string text(const char* format, double value);

/// For CSV, to six digits.
std::string number(double value);

}  // namespace accuracy_cost
