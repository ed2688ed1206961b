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

GrainBody body_of(const Grain& grain) {
  const auto shape = grain.is_capsule ? GrainBody::Shape::Capsule : GrainBody::Shape::Superellipsoid;
  return {grain.half_axes, grain.delta, grain.epsilon, grain.rounding, shape};
}

}  // namespace

double GrainBody::smallest_half_axis() const { return *std::ranges::min_element(half_axes); }

std::array<double, 3> GrainBody::core_half_axes() const {
  const auto [a, b, c] = half_axes;
  return {a - rounding, b - rounding, c - rounding};
}

double GrainBody::bounding_radius() const {
  if (shape == Shape::Capsule) return half_axes[2];
  const auto [a, b, c] = core_half_axes();
  // A superovoid is nowhere wider than a superellipsoid of its widest section.
  return farthest(farthest((1 + std::abs(taper[0])) * a, (1 + std::abs(taper[1])) * b, delta), c, epsilon) + rounding;
}

std::vector<GrainPart> Grain::all_parts() const {
  if (!parts.empty()) return parts;
  return {{body_of(*this), density}};
}

double Grain::smallest_half_axis() const {
  if (parts.empty()) return *std::ranges::min_element(half_axes);
  const auto smallest = [](const GrainPart& part) { return part.body.smallest_half_axis(); };
  return smallest(*std::ranges::min_element(parts, {}, smallest));
}

double Grain::bounding_radius() const {
  if (parts.empty()) return body_of(*this).bounding_radius();
  double radius = 0;
  for (const GrainPart& part : parts) {
    const auto [x, y, z] = part.position;
    radius = std::max(radius, std::hypot(x, y, z) + part.body.bounding_radius());
  }
  return radius;
}

double Grain::sieve_size() const {
  const auto [a, b, c] = half_axes;
  return 2 * std::max(std::min(a, b), std::min(std::max(a, b), c));
}

}  // namespace falling_particles
