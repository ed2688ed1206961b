// Reads the sizes of grains from a scene file.
#pragma once

#include <optional>

#include "base/toml_input.hpp"
#include "model/size_distribution.hpp"

namespace falling_particles {

/// Reads `size` of a [[grain]], if it has one. Throws InputError. The result is the distribution of the factor on all lengths of
/// the grain. `sieve_size` (m) is its sieve size in the catalogue.
std::optional<SizeDistribution> load_sizes(const TomlTable& entry, double sieve_size);

}  // namespace falling_particles
