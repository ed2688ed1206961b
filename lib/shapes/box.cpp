#include "supernormal/shapes/box.hpp"

#include <cmath>

#include "base/validation.hpp"

namespace supernormal {

Box::Box(const Vector3& half_lengths) : half_lengths_(half_lengths) {
  const char* const names[] = {"half-length x", "half-length y", "half-length z"};
  for (int axis = 0; axis < 3; ++axis) require_in(names[axis], half_lengths[axis], 0, kMaxLength, "m");
}

void Box::evaluate(const Vector3& n, Order order, Jet& jet) const {
  jet.h = half_lengths_.dot(n.cwiseAbs());
  if (order == Order::Value) return;
  for (int axis = 0; axis < 3; ++axis) jet.r[axis] = std::copysign(half_lengths_[axis], n[axis]);
  if (order == Order::Point) return;
  jet.H.setZero();
}

void Box::add_active_vertices(const Vector3& /*n*/, const Vector3& /*toward*/, ActiveVertices& vertices) const {
  for (const double x : {-half_lengths_.x(), half_lengths_.x()}) {
    for (const double y : {-half_lengths_.y(), half_lengths_.y()}) {
      for (const double z : {-half_lengths_.z(), half_lengths_.z()}) vertices.add(Vector3(x, y, z));
    }
  }
}

bool Box::surely_contains(const Vector3& point) const { return (point.array().abs() <= half_lengths_.array()).all(); }

double Box::min_curvature_radius_estimate() const { return 0; }

MassProperties Box::mass_properties() const {
  MassProperties mass;
  mass.volume = 8 * half_lengths_.prod();
  mass.second_moment = (mass.volume / 3 * half_lengths_.cwiseAbs2()).asDiagonal();
  return mass;
}

void Box::add_parameter_gradient(const Vector3& n, const Vector3& /*r*/, ParameterGradient& gradient) const {
  gradient.add("x", std::abs(n.x()));
  gradient.add("y", std::abs(n.y()));
  gradient.add("z", std::abs(n.z()));
}

}  // namespace supernormal
