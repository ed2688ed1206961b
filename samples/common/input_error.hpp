// The exception for mistakes in the user's input.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace common {

/// Thrown when the user's input is wrong. what() is the whole message for the user: file, line, value and what is allowed.
class InputError : public std::runtime_error {
 public:
  static constexpr std::string_view kText = "the text";  ///< in place of a file, for a text that is in none

  using std::runtime_error::runtime_error;
  InputError(const std::string& file, unsigned line, const std::string& text)
      : std::runtime_error(file + (file == kText ? ", line " : ":") + std::to_string(line) + ": " + text) {}
};

}  // namespace common
