// Programs that end as a script.
#pragma once

#include <string>

namespace common {

/// Becomes Debian's Python running this script with one argument. Throws if it cannot be run.
[[noreturn]] void become_python(const std::string& script, const std::string& argument);

}  // namespace common
