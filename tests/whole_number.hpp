// Numbers on the command line of a test program.
#pragma once

#include <charconv>
#include <cstring>
#include <system_error>

namespace supernormal::test {

/// The number that a text is, from 0; -1 where it is none.
inline int whole_number(const char* text) {
  int value = 0;
  const char* const end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, value);
  return error == std::errc() && rest == end && value >= 0 ? value : -1;
}

}  // namespace supernormal::test
