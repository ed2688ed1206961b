// What noise does to the distances of points from a curved surface.
#pragma once

#include "distance.hpp"

namespace fit {

/// The mean distance, from the surface, of points that scatter about one of it alike in all directions with the standard deviation
/// sigma: sigma^2 K / 2 for each principal curvature K = 1/rho (the second-order term of the distance; Kanatani, Statistical
/// Optimization for Geometric Computation, section 14). A body that ignores it becomes too large. Near an edge, rho < sigma, the
/// series fails: 1/rho becomes 1/sqrt(rho^2 + (0.4 sigma)^2), which for rho = 0 is the mean distance sqrt(pi/2) sigma from a line.
double noise_offset(const DistanceFunction& function, const Witness& witness, double sigma);

}  // namespace fit
