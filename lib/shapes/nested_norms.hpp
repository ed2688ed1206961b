// What superellipsoids and superovoids share: their norms, and what follows from these.
#pragma once

#include <cmath>

#include "shapes/power_norm.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Its support function nests the dual norms: of (a nx, b ny) with the exponent p, and of that norm and c nz with q. Its implicit
/// equation nests the gauges: of (x/a, y/b) with the exponent delta, and of that norm and z/c with epsilon.
struct NestedNorms {
  NestedNorms(double delta, double epsilon)
      : inner_support(PowerNorm::dual_to_exponent(delta)),
        outer_support(PowerNorm::dual_to_exponent(epsilon)),
        inner_gauge(PowerNorm::of_exponent(delta)),
        outer_gauge(PowerNorm::of_exponent(epsilon)) {}

  PowerNorm inner_support, outer_support;
  PowerNorm inner_gauge, outer_gauge;
};

/// Whether a normal rotates about an axis by more than 45 degrees. The arguments are the normal's components across the axis,
/// scaled by the half-axes of the section.
///
/// Along a sharp section the boundary point is a high power of the normal's direction. There the normal moves by itself, because
/// the point determines it less accurately. Near the axis, as on a flat face, the components across the axis may be arbitrarily
/// small. There a step beyond the section's radius of curvature rotates them far, and the point determines the normal more
/// accurately.
inline bool rotates_far(const Eigen::Vector2d& normal, const Eigen::Vector2d& moved) {
  return std::abs(normal.x() * moved.y() - normal.y() * moved.x()) > normal.dot(moved);
}

/// h depends on a n_x, b n_y and c n_z, so a dh/da = n_x dh/dn_x = n_x r_x.
inline void add_half_axes_gradient(const Vector3& half_axes, const Vector3& n, const Vector3& r, ParameterGradient& gradient) {
  const Vector3 slopes = n.cwiseProduct(r).cwiseQuotient(half_axes);
  gradient.add("a", slopes.x());
  gradient.add("b", slopes.y());
  gradient.add("c", slopes.z());
}

/// -u log u - v log v of the shares u = x/(x + y) and v = y/(x + y) of two numbers that are not negative. Let t = (X^p + Y^p)^(1/p)
/// be a dual norm, p = e/(e - 1). Then d log t / d log p = -entropy/p with the shares of X^p and Y^p, which are the shares of X
/// dt/dX and Y dt/dY in t. So dt/de = t entropy / e^2.
inline double entropy(double x, double y) {
  const double larger = x < y ? y : x, smaller = x < y ? x : y;
  if (!(smaller > 0)) return 0;
  const double ratio = smaller / larger, share = ratio / (1 + ratio);
  return std::log1p(ratio) - (ratio > 0 ? share * std::log(ratio) : 0);
}

}  // namespace supernormal
