// The hardware and software of a measurement.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace accuracy_cost {

/// Names and values: processor, compiler, flags, versions of the libraries.
std::vector<std::pair<std::string, std::string>> environment();

}  // namespace accuracy_cost
