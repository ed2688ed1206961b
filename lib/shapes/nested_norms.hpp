// The norms of a superellipsoid or a superovoid.
#pragma once

#include "shapes/power_norm.hpp"

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

}  // namespace supernormal
