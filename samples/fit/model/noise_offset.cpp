#include "noise_offset.hpp"

#include <algorithm>
#include <cmath>

namespace fit {

double noise_offset(const DistanceFunction& function, const Witness& witness, double sigma) {
  const Vector3 n = function.to_body(witness.normal).normalized();
  const Matrix3 H = function.shape().jet(n).H;
  // H n = 0, so the principal radii of curvature are the other two eigenvalues. Their product is the sum of the principal minors.
  // The largest minor is exact for a flat face with one or two radii of 1e30.
  const auto minor = [&](int i, int j) { return H(i, i) * H(j, j) - H(i, j) * H(i, j); };
  const double product = minor(0, 1) + minor(1, 2) + minor(2, 0);
  const double half = H.trace() / 2, root = std::sqrt(std::max(0.0, half * half - product));
  const double larger = half + root, smaller = larger > 0 ? product / larger : 0;
  const auto curvature = [&](double radius) { return 1 / std::hypot(radius, 0.4 * sigma); };
  return sigma * sigma / 2 * (curvature(larger) + curvature(std::max(0.0, smaller)));
}

}  // namespace fit
