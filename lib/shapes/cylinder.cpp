#include "supernormal/shapes/cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/validation.hpp"

namespace supernormal {
namespace {

// Nearer to the axis than this, the azimuth of a normal is only rounding error.
constexpr double kPole = 1e-15;

// A cap's normal may deviate from the axis by this much after a rotation there and back by rounded matrices.
constexpr double kCap = 4e-15;

}  // namespace

Cylinder::Cylinder(double radius, double half_length)
    : radius_(require_in("radius", radius, 0, kMaxLength, "m")),
      half_length_(require_in("half-length", half_length, 0, kMaxLength, "m")) {}

void Cylinder::evaluate(const Vector3& n, Order order, Jet& jet) const {
  const double across = n.head<2>().norm();
  jet.h = radius_ * across + half_length_ * std::abs(n.z());
  if (order == Order::Value) return;
  const bool is_pole = across < kPole;
  const Vector3 radial = is_pole ? Vector3(0, 0, 0) : Vector3(n.x() / across, n.y() / across, 0);
  jet.r = radius_ * radial;
  jet.r.z() = std::copysign(half_length_, n.z());
  if (order == Order::Point) return;
  // The boundary point moves along the edge with the normal's azimuth. A cap has active vertices instead of a Hessian.
  const Vector3 along_rim(-radial.y(), radial.x(), 0);
  jet.H = across < kCap ? Matrix3(Matrix3::Zero()) : Matrix3(radius_ / across * along_rim * along_rim.transpose());
}

void Cylinder::add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const {
  const Vector3 end(0, 0, half_length_);
  const double across = n.head<2>().norm();
  if (across < kCap) {
    // An equilateral triangle of points on the edge contains the cap's point nearest to `toward`. One of its vertices is in the
    // direction of `toward`.
    const double distance = toward.head<2>().norm();
    const Vector3 rim =
        distance > kPole * radius_ ? Vector3(toward.x(), toward.y(), 0) / distance * radius_ : Vector3(radius_, 0, 0);
    const Vector3 middle = -0.5 * rim;
    const Vector3 aside = 0.5 * std::numbers::sqrt3 * Vector3(-rim.y(), rim.x(), 0);
    for (const Vector3& point : {rim, Vector3(middle + aside), Vector3(middle - aside)})
      vertices.add(point + (n.z() < 0 ? -end : end));
  } else {
    const Vector3 rim = Vector3(n.x(), n.y(), 0) * (radius_ / across);
    vertices.add(rim - end);
    vertices.add(rim + end);
  }
}

bool Cylinder::crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const {
  if (from.z() * to.z() <= 0 || from.x() * to.x() + from.y() * to.y() >= 0) return false;
  face = Vector3(0, 0, std::copysign(1.0, to.z()));
  return true;
}

bool Cylinder::surely_contains(const Vector3& point) const {
  return std::abs(point.z()) <= half_length_ && point.head<2>().squaredNorm() <= radius_ * radius_;
}

double Cylinder::min_curvature_radius_estimate() const { return 0; }

MassProperties Cylinder::mass_properties() const {
  MassProperties mass;
  mass.volume = 2 * std::numbers::pi * radius_ * radius_ * half_length_;
  const double across = radius_ * radius_ / 4;
  mass.second_moment = mass.volume * Vector3(across, across, half_length_ * half_length_ / 3).asDiagonal();
  return mass;
}

void Cylinder::add_parameter_gradient(const Vector3& n, const Vector3& /*r*/, ParameterGradient& gradient) const {
  gradient.add("radius", n.head<2>().norm());
  gradient.add("half_length", std::abs(n.z()));
}

}  // namespace supernormal
