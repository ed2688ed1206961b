// Random bodies.
#pragma once

#include <random>

#include "model/body.hpp"

namespace fit {

/// Uniform in [0, 1), the same with every standard library.
double uniform(std::mt19937_64& random);

/// A superellipsoid in a random orientation, with distinct half-axes (0.4 to 1.6, in any order). The exponents are in [1.3, 8],
/// uniform in ln(exponent - 1).
Body random_superellipsoid(std::mt19937_64& random);

/// The same with a taper of at most `share` of the limit of a convex body, of either sign.
Body random_superovoid(std::mt19937_64& random, double share);

}  // namespace fit
