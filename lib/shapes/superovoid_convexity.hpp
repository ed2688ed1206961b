// Bounds on the tapers that keep a superellipsoid convex.
#pragma once

namespace supernormal {

/// The largest |taper| for equal tapers in x and y, and an upper bound on each otherwise: 2^(1/epsilon) (epsilon - 1)/epsilon.
double largest_convex_taper(double epsilon);

/// The amount by which two different tapers, each within largest_convex_taper(), violate convexity, and the height.
struct TaperedConvexity {
  double height;  ///< z/c at which `margin` is taken
  double margin;  ///< smallest second derivative of the section's width along z, in units of that of the untapered body; < 0: not
                  ///< convex
};

/// For epsilon <= 2, the minimum over all heights and directions in the section.
TaperedConvexity least_convex(double delta, double epsilon, double taper_x, double taper_y);

/// Throws std::invalid_argument, naming the condition that fails, unless the tapered superellipsoid is convex. Exponents must be
/// valid.
void require_convex_taper(double delta, double epsilon, double taper_x, double taper_y);

}  // namespace supernormal
