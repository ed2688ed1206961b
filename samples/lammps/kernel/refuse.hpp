// The message about a parameter outside its range.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace granular {

/// Throws std::invalid_argument with the parameter, its value and the valid range.
[[noreturn]] inline void refuse(const std::string& name, double value, const std::string& range) {
  std::ostringstream message;
  message << name << " = " << value << " is outside " << range;
  throw std::invalid_argument(message.str());
}

}  // namespace granular
