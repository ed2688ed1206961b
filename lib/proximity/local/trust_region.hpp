// The quadratic model of an ascent and its maximum within a disc.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/tangent_plane.hpp"

namespace supernormal {

/// The length of (x, y), which may be too small to square. The digits of std::hypot depend on whether it was compiled with fused
/// multiply-add.
inline double length_of(double x, double y) {
  const double larger = std::max(std::abs(x), std::abs(y)), smaller = std::min(std::abs(x), std::abs(y));
  if (larger == 0) return 0;
  const double ratio = smaller / larger;
  return larger * std::sqrt(1 + ratio * ratio);
}

/// gain(u) = g.u - 1/2 u.A u, the second-order change of s over the tangent plane.
struct QuadraticModel {
  Vector2 g;     // m
  Symmetric2 A;  // m

  double gain(const Vector2& u) const { return g.dot(u) - 0.5 * u.dot(A * u); }

  /// m; the largest gain over the whole plane; infinite unless A is positive definite. A curvature within `rounding` (m) of zero
  /// counts as zero. In such a direction, as around the equator of a spheroid with a point at its centre, the gain is the slope's
  /// over a quarter turn.
  double largest_gain(double rounding = 0) const;

  /// The maximum over |u| <= radius: the Newton step if it fits, otherwise a point on the circle (More and Sorensen 1983, in the
  /// eigenvectors of A).
  Vector2 maximize(double radius) const;

  /// maximize(radius) and largest_gain(rounding) together. If A is well-conditioned and positive definite, this costs little more
  /// than a division.
  struct Peak {
    Vector2 u;
    double whole_gain;  ///< m
  };
  Peak peak(double radius, double rounding) const;
};

}  // namespace supernormal
