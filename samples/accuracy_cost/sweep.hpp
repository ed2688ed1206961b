// What each digit costs: every method swept over its own tolerance.
#pragma once

#include <cstdint>
#include <string>

#include "measurement.hpp"

namespace accuracy_cost {

/// Draws pairs and writes a CSV with a line per class, situation, method and tolerance, for figures.gp. Throws when it cannot be
/// written.
void write_sweep(std::size_t pairs, std::uint64_t seed, const Effort& effort, const std::string& path);

}  // namespace accuracy_cost
