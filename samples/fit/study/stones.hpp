// Stones of one kind, of different sizes and shapes.
#pragma once

#include <cstdint>
#include <vector>

#include "model/body.hpp"

namespace fit {

/// Superellipsoids in random poses. The size, the cube root of the volume, is lognormal with the median 10 mm and the geometric
/// deviation 1.25. The ratios b/a and c/a are normal, 0.8 ± 0.05 and 0.6 ± 0.04. The logarithms of the exponents less 1 are normal,
/// with the medians 2.4 and 2.8 of the exponents delta and epsilon, and the deviation 0.1.
std::vector<Body> make_stones(std::size_t count, std::uint64_t seed);

}  // namespace fit
