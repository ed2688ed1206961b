// Superovoids of all exponents and tapers.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "shapes/superovoid_convexity.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/shape_samples.hpp"

namespace supernormal::test {

inline std::string text(const Superovoid& shape) {
  std::ostringstream out;
  out << "half-axes " << text(shape.half_axes()) << " delta " << shape.delta() << " epsilon " << shape.epsilon() << " tapers "
      << shape.taper_x() << " " << shape.taper_y();
  return out.str();
}

/// Both tapers as shares of the largest.
struct Tapers {
  double x, y;
};

inline const std::vector<Tapers> kTapers = {{0.3, 0.3}, {-0.9, -0.9}, {1, 1}, {0.5, -0.2}, {0, 0.7}};

/// Superovoids of all exponents up to `max_exponent`, with different tapers where that is convex.
inline std::vector<Superovoid> superovoids(double min_exponent, double max_exponent, const std::vector<Tapers>& tapers = kTapers) {
  std::vector<Superovoid> shapes;
  for (const Vector3& half_axes : {Vector3(3, 2, 1), Vector3(0.02, 1, 0.3)}) {
    for (const double delta : {1.01, 1.3, 2.0, 2.4, 7.5, 50.0, 200.0, 1000.0}) {
      for (const double epsilon : {1.01, 1.3, 1.8, 2.0, 2.4, 7.5, 50.0, 200.0, 1000.0}) {
        if (std::min(delta, epsilon) < min_exponent || std::max(delta, epsilon) > max_exponent) continue;
        const double largest = Superovoid::max_taper(epsilon);
        for (const Tapers& share : tapers) {
          const double x = share.x * largest, y = share.y * largest;
          if (x != y && (epsilon > 2 || least_convex(delta, epsilon, x, y).margin < 0.01 * (epsilon - 1))) continue;
          shapes.emplace_back(half_axes, delta, epsilon, x, y);
        }
      }
    }
  }
  return some_of(shapes);
}

}  // namespace supernormal::test
