// The length of a short vector of the tangent plane.
#pragma once

#include <algorithm>
#include <cmath>

namespace supernormal {

/// The length of (x, y), which may be too small to square. The digits of std::hypot depend on whether it was compiled with fused
/// multiply-add.
inline double length_of(double x, double y) {
  const double larger = std::max(std::abs(x), std::abs(y)), smaller = std::min(std::abs(x), std::abs(y));
  if (larger == 0) return 0;
  const double ratio = smaller / larger;
  return larger * std::sqrt(1 + ratio * ratio);
}

}  // namespace supernormal
