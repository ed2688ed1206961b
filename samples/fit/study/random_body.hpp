// Bodies drawn by lot.
#pragma once

#include <random>

#include "model/body.hpp"

namespace fit {

/// Uniform in [0, 1), the same with every library.
double uniform(std::mt19937_64& random);

/// A superellipsoid with half-axes that differ (0.4 to 1.6, in any order) in any attitude; exponents in [1.3, 8], evenly in the
/// logarithm of what they exceed 1 by.
Body random_superellipsoid(std::mt19937_64& random);

/// The same with a taper up to `share` of what a convex body may have, either way.
Body random_superovoid(std::mt19937_64& random, double share);

}  // namespace fit
