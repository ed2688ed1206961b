// The message of a constructor that refuses its arguments.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace supernormal::test {

inline std::string refusal(const std::function<void()>& construct) {
  try {
    construct();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace supernormal::test
