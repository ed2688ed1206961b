// Rays against superellipsoids, and their hits by the implicit equation only.
#pragma once

#include <cmath>
#include <limits>

#include "supernormal/raycast/ray.hpp"
#include "support/reference_pairs.hpp"
#include "support/shape_samples.hpp"
#include "support/superellipsoid_classes.hpp"
#include "support/traps.hpp"
#include "support/without_hessian.hpp"

namespace supernormal::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Ray {
  Vector3 origin, direction;

  Vector3 at(double t) const { return origin + t * direction; }
};

class RandomRays : public Draw {
 public:
  using Draw::Draw;

  Superellipsoid shape(const SuperellipsoidClass& kind) { return draw_superellipsoid(kind, *this); }

  /// A ray past the body. Its line goes through `factor` times a point of the silhouette, so it hits if factor < 1. It begins in
  /// front of the body.
  Ray past(const Superellipsoid& shape, double factor) {
    const Vector3 v = direction();
    const Vector3 w = direction().cross(v).normalized();
    const double start = uniform(2, 5) * shape.half_axes().norm();
    return {factor * shape.point(w) - start * v, v};
  }

  /// `factor` times a point of the boundary.
  Vector3 point(const Superellipsoid& shape, double factor) {
    const Vector3 x = direction();
    return x * (factor / gauge(shape, x));
  }
};

/// The gauge along a line is convex. Its smallest value is found by trisection, the crossings of 1 by bisection.
struct Crossings {
  double least = 0;            // the smallest value of the gauge
  double entry = 0, exit = 0;  // distances along the ray
};

inline Crossings find_crossings(const Superellipsoid& shape, const Ray& ray) {
  const auto value = [&](double t) { return gauge(shape, ray.at(t)); };
  const double middle = -ray.origin.dot(ray.direction);
  const double reach = 2 * shape.half_axes().norm();
  double low = middle - reach, high = middle + reach;
  for (int step = 0; step < 120; ++step) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    value(a) < value(b) ? high = b : low = a;
  }
  const double inside = 0.5 * (low + high);
  const auto bisect = [&](double outside) {
    double in = inside;
    for (int step = 0; step < 80; ++step) {
      const double half = 0.5 * (in + outside);
      (value(half) < 1 ? in : outside) = half;
    }
    return 0.5 * (in + outside);
  };
  return {value(inside), bisect(middle - reach), bisect(middle + reach)};
}

/// The unit normal of the level surface of the gauge at a point.
inline Vector3 level_normal(const Superellipsoid& shape, const Vector3& point) {
  const Vector3 x = point.cwiseQuotient(shape.half_axes()).cwiseAbs();
  const double large = std::max(x.x(), x.y());
  const double delta = shape.delta(), epsilon = shape.epsilon();
  const double t = large * std::pow(std::pow(x.x() / large, delta) + std::pow(x.y() / large, delta), 1 / delta);
  const double slope = std::pow(t, epsilon - 1);
  Vector3 n(slope * std::pow(x.x() / t, delta - 1), slope * std::pow(x.y() / t, delta - 1), std::pow(x.z(), epsilon - 1));
  for (int i = 0; i < 3; ++i) n[i] = std::copysign(n[i] / shape.half_axes()[i], point[i]);
  return n.normalized();
}

/// The distance of a hit from the boundary: to the parallel tangent plane by the implicit equation, or to the boundary point with
/// this normal.
inline double distance_to_boundary(const Superellipsoid& shape, const RayHit& hit) {
  const double from_level = std::abs(gauge(shape, hit.point) - 1) * std::abs(level_normal(shape, hit.point).dot(hit.point));
  return std::min(from_level, (shape.point(hit.normal) - hit.point).norm());
}

}  // namespace supernormal::test
