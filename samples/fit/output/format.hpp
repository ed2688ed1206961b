// Text by printf's patterns.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>
#include <vector>

namespace fit {

/// At most 511 characters.
[[gnu::format(printf, 1, 2)]] inline std::string format(const char* pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  std::vector<char> text(512);
  std::vsnprintf(text.data(), text.size(), pattern, arguments);
  va_end(arguments);
  return text.data();
}

}  // namespace fit
