// The exception for mistakes in the user's input.
#pragma once

#include <stdexcept>
#include <string>

namespace falling_particles {

/// Thrown when the user's input is wrong. what() is the whole message for the user: file, line, value and what is allowed.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  InputError(const std::string& file, unsigned line, const std::string& text)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + text) {}
};

}  // namespace falling_particles
