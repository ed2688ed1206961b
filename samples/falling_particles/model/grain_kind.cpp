#include "grain_kind.hpp"

#include <algorithm>
#include <cmath>

namespace falling_particles {
namespace {

/// The distance of the farthest point of |x/a|^n + |y/b|^n = 1 from the centre. For n <= 2 this point is on an axis. For larger n
/// the distance is the norm of (a, b) with exponent 2 n / (n - 2), by Hoelder's inequality. Nesting this function gives the
/// distance for a superellipsoid.
double farthest(double a, double b, double exponent) {
  if (exponent <= 2) return std::max(a, b);
  const double dual = 2 * exponent / (exponent - 2);
  const double larger = std::max(a, b);
  return larger * std::pow(1 + std::pow(std::min(a, b) / larger, dual), 1 / dual);
}

ConvexBody body_of(const GrainKind& kind) {
  const auto shape = kind.is_capsule ? ConvexBody::Shape::Capsule : ConvexBody::Shape::Superellipsoid;
  return {kind.half_axes, kind.delta, kind.epsilon, kind.rounding, shape};
}

}  // namespace

double ConvexBody::smallest_half_axis() const { return *std::ranges::min_element(half_axes); }

std::array<double, 3> ConvexBody::core_half_axes() const {
  const auto [a, b, c] = half_axes;
  return {a - rounding, b - rounding, c - rounding};
}

double ConvexBody::bounding_radius() const {
  if (shape == Shape::Capsule) return half_axes[2];
  const auto [a, b, c] = core_half_axes();
  // No section of a superovoid is wider than a superellipsoid of its widest section.
  return farthest(farthest((1 + std::abs(taper[0])) * a, (1 + std::abs(taper[1])) * b, delta), c, epsilon) + rounding;
}

std::vector<Component> GrainKind::all_components() const {
  if (!components.empty()) return components;
  return {{body_of(*this), density}};
}

double GrainKind::smallest_half_axis() const {
  if (components.empty()) return *std::ranges::min_element(half_axes);
  const auto smallest = [](const Component& component) { return component.body.smallest_half_axis(); };
  return smallest(*std::ranges::min_element(components, {}, smallest));
}

double GrainKind::bounding_radius() const {
  if (components.empty()) return body_of(*this).bounding_radius();
  double radius = 0;
  for (const Component& component : components) {
    const auto [x, y, z] = component.position;
    radius = std::max(radius, std::hypot(x, y, z) + component.body.bounding_radius());
  }
  return radius;
}

double GrainKind::sieve_size() const {
  const auto [a, b, c] = half_axes;
  return 2 * std::max(std::min(a, b), std::min(std::max(a, b), c));
}

}  // namespace falling_particles
