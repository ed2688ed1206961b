// The machine and the build of a measurement.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace common {

/// Names and values, as a table of measurements begins with them.
using Environment = std::vector<std::pair<std::string, std::string>>;

/// Processor, compiler, flags, commit, and the version of Eigen. A program adds the libraries that it measures.
Environment environment();

}  // namespace common
