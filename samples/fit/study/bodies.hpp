// Bodies whose fits are known: random ones, compounds and stones.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "model/body.hpp"
#include "model/cloud.hpp"

namespace fit {

/// A superellipsoid in a random orientation, with distinct half-axes (0.4 to 1.6, in any order). The exponents are in [1.3, 8],
/// uniform in ln(exponent - 1).
Body random_superellipsoid(std::mt19937_64& random);

/// The same with a taper of at most `share` of the limit of a convex body, of either sign.
Body random_superovoid(std::mt19937_64& random, double share);

/// "dumbbell": two discs and a bar. "molar": a crown on two roots, all superovoids. Throws std::invalid_argument for other names.
std::vector<Body> make_compound(const std::string& name);

/// `count` random points on each body, without those inside another, with isotropic noise of standard deviation `sigma` (m).
Cloud scatter_union(const std::vector<Body>& bodies, std::size_t count, double sigma, std::uint64_t seed);

/// Superellipsoids in random poses. The size, the cube root of the volume, is lognormal with the median 10 mm and the geometric
/// deviation 1.25. The ratios b/a and c/a are normal, 0.8 ± 0.05 and 0.6 ± 0.04. The logarithms of the exponents less 1 are normal,
/// with the medians 2.4 and 2.8 of the exponents delta and epsilon, and the deviation 0.1.
std::vector<Body> make_stones(std::size_t count, std::uint64_t seed);

}  // namespace fit
