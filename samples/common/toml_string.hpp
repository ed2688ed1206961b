// Strings in TOML files.
#pragma once

#include <string>

namespace common {

/// Writes `text` as a quoted TOML string on one line. No TOML file may contain bytes that are not UTF-8: they are replaced by
/// characters.
std::string toml_string(const std::string& text);

}  // namespace common
