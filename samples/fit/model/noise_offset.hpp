// The bias of point distances from a curved surface by noise.
#pragma once

#include "distance.hpp"

namespace fit {

/// The mean distance of points from a surface about which they scatter isotropically with the standard deviation sigma. It is
/// sigma^2 K / 2 for each principal curvature K = 1/rho, the second-order term of the distance (Kanatani, Statistical Optimization
/// for Geometric Computation, section 14). A fit that ignores it gives too large a body. At an edge, rho < sigma, the series fails.
/// Therefore 1/rho is replaced by 1/sqrt(rho^2 + (0.4 sigma)^2). For rho = 0 this gives the mean distance sqrt(pi/2) sigma from a
/// line.
double noise_offset(const DistanceFunction& function, const Witness& witness, double sigma);

}  // namespace fit
