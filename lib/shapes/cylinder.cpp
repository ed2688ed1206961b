#include "supernormal/shapes/cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shapes/validation.hpp"

namespace supernormal {

Cylinder::Cylinder(double radius, double half_length)
    : radius_(require_in("radius", radius, 0, kMaxLength, "m")),
      half_length_(require_in("half-length", half_length, 0, kMaxLength, "m")) {}

void Cylinder::evaluate(const Vector3& n, Order order, Jet& jet) const {
  const double across = std::hypot(n.x(), n.y());
  jet.h = radius_ * across + half_length_ * std::abs(n.z());
  if (order == Order::Value) return;
  const Vector3 radial = across > 0 ? Vector3(n.x() / across, n.y() / across, 0) : Vector3(0, 0, 0);
  jet.r = radius_ * radial;
  jet.r.z() = std::copysign(half_length_, n.z());
  if (order == Order::Point) return;
  // The rim turns with the normal's azimuth; a cap does not.
  const Vector3 along_rim(-radial.y(), radial.x(), 0);
  const double rim_radius = across > 0 ? radius_ / across : 0;
  jet.H = rim_radius * along_rim * along_rim.transpose();
}

void Cylinder::add_corners(const Vector3& n, const Vector3& toward, Corners& corners) const {
  Vector3 rim(n.x(), n.y(), 0);
  if (rim.x() == 0 && rim.y() == 0) {  // a cap: its point nearest to `toward`
    const double distance = std::hypot(toward.x(), toward.y());
    rim = Vector3(toward.x(), toward.y(), 0) * (distance > radius_ ? radius_ / distance : 1);
  } else {
    rim *= radius_ / std::hypot(n.x(), n.y());
  }
  const Vector3 end(0, 0, half_length_);
  corners.add(rim - end);
  corners.add(rim + end);
}

SharpFeatures Cylinder::sharp_features() const { return SharpFeatures::of_box(0); }

MassProperties Cylinder::mass_properties() const {
  MassProperties mass;
  mass.volume = 2 * std::numbers::pi * radius_ * radius_ * half_length_;
  const double across = radius_ * radius_ / 4;
  mass.second_moment = mass.volume * Vector3(across, across, half_length_ * half_length_ / 3).asDiagonal();
  return mass;
}

}  // namespace supernormal
