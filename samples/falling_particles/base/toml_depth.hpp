// How deeply the tables and arrays of a TOML text are nested.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace falling_particles {

/// The most levels of one TOML statement: dotted keys, arrays and tables within each other. No scene needs more than six.
inline constexpr std::size_t kMostTomlLevels = 100;

/// The first line, from 1, of a statement with more levels; empty if there is none. A parser descends a level by recursion, so a
/// text of 50 000 dots would overflow its stack. This function looks at the characters alone. In invalid TOML, the answer holds up
/// to the place that the parser refuses.
std::optional<unsigned> find_deep_toml(std::string_view text);

}  // namespace falling_particles
