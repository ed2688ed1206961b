#include "common/toml_string.hpp"

#include <toml++/toml.h>

#include <sstream>

namespace common {

std::string toml_string(const std::string& text) {
  const toml::value<std::string> value(text);
  std::ostringstream stream;
  // The flags exclude literal and multi-line strings.
  stream << toml::toml_formatter(value, toml::format_flags::allow_unicode_strings);
  return stream.str();
}

}  // namespace common
