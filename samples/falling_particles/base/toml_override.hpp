// Replacement of values of a TOML file before it is read.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace falling_particles {

/// Sets values of `root` one after the other, each given as KEY=VALUE. The value is TOML. The key is a path of names separated by
/// dots: `time.step`. Brackets select an entry of an array by its index from 0: `container.width[1]`. They also select it by its
/// `name`, or by its `kind` if it has no name: `grain[pea].count`. Missing tables and keys are added; the reader of a table refuses
/// unknown ones. The source path of each new value is the option, `--set KEY=VALUE`, for messages. Throws InputError, which names
/// the option, when an assignment is not of this form or selects no entry.
void set_values(toml::table& root, const std::vector<std::string>& assignments);

}  // namespace falling_particles
