// The message with which a call refuses its input.
#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace supernormal::test {

/// The message of the error; "" if the call accepts its input.
template <typename Error = std::invalid_argument>
std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline void check_contains(const std::string& message, const std::string& part) {
  if (message.find(part) == std::string::npos) FAIL_CHECK("\"", message, "\" does not contain \"", part, "\"");
}

}  // namespace supernormal::test
