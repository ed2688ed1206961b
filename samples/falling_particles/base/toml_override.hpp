// Replacement of values of a TOML file before it is read.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace falling_particles {

/// Sets values of `root` one after the other, each given as KEY=VALUE. The value is TOML. The key is a path of names separated by
/// dots: `time.step`. Brackets select an entry of an array by its index from 0: `container.width[1]`. They also select it by its
/// `name`, or by its `kind` if it has no name: `grain[pea].count`. Missing tables and keys are added; the reader of a table refuses
/// unknown ones. The source path of each new value is the option, `--set KEY=VALUE`, for messages. Throws InputError, which names
/// the option, when an assignment is not of this form or selects no entry.
void set_values(toml::table& root, const std::vector<std::string>& assignments);

/// The most levels of one TOML statement: dotted keys, arrays and tables within each other. No scene needs more than six.
inline constexpr std::size_t kMostTomlLevels = 100;

/// The first line, from 1, of a statement with more levels; empty if there is none. A parser descends a level by recursion, so a
/// text of 50 000 dots would overflow its stack. This function looks at the characters alone. In invalid TOML, the answer holds up
/// to the place that the parser refuses.
std::optional<unsigned> find_deep_toml(std::string_view text);

}  // namespace falling_particles
