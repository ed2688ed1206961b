// Derivatives of support functions with respect to half-axes and exponents.
#pragma once

#include <cmath>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

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
