// Bounds on the tapers of a convex superovoid.
#pragma once

namespace supernormal {

/// 2^(1/epsilon) (epsilon - 1)/epsilon: the largest |taper| of a convex body if both tapers are equal, and an upper bound on each
/// otherwise.
double largest_convex_taper(double epsilon);

/// The height at which two different tapers, each within largest_convex_taper(), come nearest to violating convexity.
struct TaperedConvexity {
  double height;  ///< z/c at which `margin` is taken
  double margin;  ///< -g'' of the section's width g(z/c), scaled so that it is epsilon - 1 for the untapered body; < 0: not convex
};

/// For epsilon <= 2: the minimum over all heights and directions in the section.
TaperedConvexity least_convex(double delta, double epsilon, double taper_x, double taper_y);

/// Throws std::invalid_argument, with the condition that fails, if the tapered superellipsoid is not convex. The exponents must be
/// valid.
void require_convex_taper(double delta, double epsilon, double taper_x, double taper_y);

}  // namespace supernormal
