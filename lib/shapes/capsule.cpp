#include "supernormal/shapes/capsule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/validation.hpp"

namespace supernormal {

Capsule::Capsule(double radius, double half_length)
    : radius_(require_in("radius", radius, 0, kMaxLength, "m")),
      half_length_(require_in("half-length", half_length, 0, kMaxLength, "m")) {}

void Capsule::evaluate(const Vector3& n, Order order, Jet& jet) const {
  jet.h = half_length_ * std::abs(n.z()) + radius_;
  if (order == Order::Value) return;
  jet.r = radius_ * n;
  jet.r.z() += std::copysign(half_length_, n.z());
  if (order == Order::Point) return;
  jet.H = radius_ * (Matrix3::Identity() - n * n.transpose());
}

// The sphere's boundary point, radius n, is the same for both ends.
void Capsule::add_active_vertices(const Vector3& n, const Vector3& /*toward*/, ActiveVertices& vertices) const {
  const Vector3 end(0, 0, half_length_);
  vertices.add(radius_ * n - end);
  vertices.add(radius_ * n + end);
}

bool Capsule::surely_contains(const Vector3& point) const {
  const double beyond = std::max(std::abs(point.z()) - half_length_, 0.0);
  return point.head<2>().squaredNorm() + beyond * beyond <= radius_ * radius_;
}

double Capsule::min_curvature_radius_estimate() const { return radius_; }

MassProperties Capsule::mass_properties() const {
  const double r = radius_;
  const double l = half_length_;
  const double wall = 2 * std::numbers::pi * r * r * l;  // volume of the cylindrical part
  const double ends = 4.0 / 3 * std::numbers::pi * r * r * r;
  // Half a ball has its centroid 3/8 r from its flat side, and half the second moment of the ball about this side.
  const double across = wall * r * r / 4 + ends * r * r / 5;
  const double along = wall * l * l / 3 + ends * (r * r / 5 + 2 * (3.0 / 8) * r * l + l * l);
  MassProperties mass;
  mass.volume = wall + ends;
  mass.second_moment = Vector3(across, across, along).asDiagonal();
  return mass;
}

void Capsule::add_parameter_gradient(const Vector3& n, const Vector3& /*r*/, ParameterGradient& gradient) const {
  gradient.add("radius", 1);
  gradient.add("half_length", std::abs(n.z()));
}

}  // namespace supernormal
