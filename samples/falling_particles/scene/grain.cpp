#include "grain.hpp"

#include <algorithm>
#include <cmath>

namespace falling_particles {
namespace {

/// The distance of the farthest point of |x/a|^n + |y/b|^n = 1 from the centre: it is on an axis for n <= 2; by Hoelder's
/// inequality it is the norm of (a, b) with exponent 2 n / (n - 2) beyond. Nesting it gives the superellipsoid's.
double farthest(double a, double b, double exponent) {
  if (exponent <= 2) return std::max(a, b);
  const double dual = 2 * exponent / (exponent - 2);
  const double larger = std::max(a, b);
  return larger * std::pow(1 + std::pow(std::min(a, b) / larger, dual), 1 / dual);
}

}  // namespace

double Grain::smallest_half_axis() const { return *std::ranges::min_element(half_axes); }

std::array<double, 3> Grain::core_half_axes() const {
  const auto [a, b, c] = half_axes;
  return {a - rounding, b - rounding, c - rounding};
}

double Grain::bounding_radius() const {
  const auto [a, b, c] = core_half_axes();
  return farthest(farthest(a, b, delta), c, epsilon) + rounding;
}

}  // namespace falling_particles
