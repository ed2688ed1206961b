#include "supernormal/shapes/sphere.hpp"

#include "base/validation.hpp"

namespace supernormal {

Sphere::Sphere(double radius) : radius_(require_in("radius", radius, 0, kMaxLength, "m")) {}

void Sphere::evaluate(const Vector3& n, Order order, Jet& jet) const {
  jet.h = radius_;
  if (order == Order::Value) return;
  jet.r = radius_ * n;
  if (order == Order::Point) return;
  jet.H = radius_ * (Matrix3::Identity() - n * n.transpose());
}

bool Sphere::surely_contains(const Vector3& point) const { return point.squaredNorm() <= radius_ * radius_; }

double Sphere::min_curvature_radius_estimate() const { return radius_; }

void Sphere::add_parameter_gradient(const Vector3& /*n*/, const Vector3& /*r*/, ParameterGradient& gradient) const {
  gradient.add("radius", 1);
}

}  // namespace supernormal
