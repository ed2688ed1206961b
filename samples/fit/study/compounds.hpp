// The compounds of samples/compound, as unions whose surfaces are sampled.
#pragma once

#include <string>
#include <vector>

#include "model/body.hpp"
#include "model/cloud.hpp"

namespace fit {

/// "dumbbell": two discs and a bar. "molar": a crown on two roots, all superovoids. Throws std::invalid_argument for other names.
std::vector<Body> make_compound(const std::string& name);

/// `count` random points on each body, without those inside another, with isotropic noise of standard deviation `sigma` (m).
Cloud scatter_union(const std::vector<Body>& bodies, std::size_t count, double sigma, std::uint64_t seed);

}  // namespace fit
