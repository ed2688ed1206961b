#include "supernormal/shapes/shape.hpp"

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error \
    "supernormal cannot be compiled with -ffast-math, -Ofast or -ffinite-math-only: infinities and NaN have meanings, and bounds count rounding errors."
#endif

#include <algorithm>
#include <cmath>

namespace supernormal {

Vector3 Shape::advance_normal(const Vector3& n, const Jet& /*jet*/, const Vector3& dn) const { return n + dn; }

void Shape::add_active_vertices(const Vector3& /*n*/, const Vector3& /*toward*/, ActiveVertices& /*vertices*/) const {}

bool Shape::crosses_curved_face(const Vector3& /*from*/, const Vector3& /*to*/, Vector3& /*face*/) const { return false; }

bool Shape::surely_contains(const Vector3& /*point*/) const { return false; }

void Shape::add_parameter_gradient(const Vector3& /*n*/, const Vector3& /*r*/, ParameterGradient& /*gradient*/) const {}

Vector3 Shape::half_extents() const {
  Vector3 half;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 e = Vector3::Unit(axis);
    half[axis] = 0.5 * (support(e) + support(-e));
  }
  return half;
}

double Shape::bounding_radius() const {
  if (traits().is_symmetric) return half_extents().norm();
  Vector3 farthest;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 e = Vector3::Unit(axis);
    farthest[axis] = std::max(std::abs(support(e)), std::abs(support(-e)));
  }
  return farthest.norm();
}

double Shape::min_curvature_radius_estimate() const {
  // An ellipsoid with the smallest half-axis c and the largest a is sharpest at the ends of a, with the radius c^2/a.
  const Vector3 half = half_extents();
  return half.minCoeff() * (half.minCoeff() / half.maxCoeff());
}

double Shape::support(const Vector3& n) const {
  Jet out;
  evaluate(n, Order::Value, out);
  return out.h;
}

Vector3 Shape::point(const Vector3& n) const {
  Jet out;
  evaluate(n, Order::Point, out);
  return out.r;
}

Jet Shape::jet(const Vector3& n) const {
  Jet out;
  evaluate(n, Order::Hessian, out);
  return out;
}

}  // namespace supernormal
