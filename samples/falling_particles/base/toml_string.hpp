// Strings in TOML files.
#pragma once

#include <string>

namespace falling_particles {

/// Writes `text` as a TOML string on one line, in quotes. Bytes that are not UTF-8, which no TOML file may hold, become
/// characters.
std::string toml_string(const std::string& text);

}  // namespace falling_particles
