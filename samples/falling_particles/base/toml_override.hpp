// Values of a TOML file that are replaced before it is read.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace falling_particles {

/// Sets values of `root` in turn, each given as KEY=VALUE: the value is TOML, the key a path of names with points between them,
/// `time.step`. An entry of an array is chosen in brackets, by its index from 0 or by its `name`, which is its `kind` where it has
/// none: `container.width[1]`, `grain[pea].count`. Tables and keys that are not there are added; what reads the table refuses those
/// that it does not know. All that is set has the option, `--set KEY=VALUE`, as the path of its source, for messages to name.
/// Throws InputError, which names the option, when an assignment is not of this form or chooses no entry.
void set_values(toml::table& root, const std::vector<std::string>& assignments);

}  // namespace falling_particles
