// How deeply the tables and arrays of a TOML text are nested.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace falling_particles {

/// Levels of one statement of TOML: keys with dots, arrays and tables within each other. No scene needs more than six.
inline constexpr std::size_t kMostTomlLevels = 100;

/// The first line, from 1, of a statement with more levels; none if there is none. A parser goes down a level by calling itself, so
/// that a text of 50 000 dots would end the program; this looks at the characters alone. A text that is not valid TOML has any
/// answer, right up to where the parser refuses it.
std::optional<unsigned> find_deep_toml(std::string_view text);

}  // namespace falling_particles
