// Numbers on the command line of a test program.
#pragma once

#include <charconv>
#include <cstring>
#include <system_error>

namespace supernormal::test {

/// The whole number in a text, from 0; -1 if the text is no such number.
inline int whole_number(const char* text) {
  int value = 0;
  const char* const end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, value);
  return error == std::errc() && rest == end && value >= 0 ? value : -1;
}

}  // namespace supernormal::test
