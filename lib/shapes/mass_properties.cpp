#include "shapes/mass_properties.hpp"

#include <cmath>
#include <numbers>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace supernormal {
namespace {

constexpr double kSphere = 4 * std::numbers::pi / 3;  // volume of the unit sphere

/// Of a body with three planes of symmetry, from its volume and mean squares <x^2>, <y^2>, <z^2>.
MassProperties symmetric(double volume, const Vector3& mean_squares) {
  MassProperties mass;
  mass.volume = volume;
  mass.second_moment = (volume * mean_squares).asDiagonal();
  return mass;
}

MassProperties swept_superellipsoid(const MassProperties& core, const Vector3& half_axes, double delta, double epsilon,
                                    double radius) {
  MassProperties mass = superellipsoid_layer(half_axes, delta, epsilon, radius);
  mass.volume += core.volume;
  mass.second_moment += core.second_moment;
  return mass;
}

/// The core swept by a sphere; by closed form and spectral quadrature where the kind of core is known.
MassProperties swept(const Rounded& shape) {
  const Shape& core = shape.core();
  const double radius = shape.radius();
  if (radius == 0) return core.mass_properties();
  if (const auto* sphere = dynamic_cast<const Sphere*>(&core)) return Sphere(sphere->radius() + radius).mass_properties();
  if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&core)) {
    return swept_superellipsoid(core.mass_properties(), ellipsoid->half_axes(), 2, 2, radius);
  }
  if (const auto* superellipsoid = dynamic_cast<const Superellipsoid*>(&core)) {
    return swept_superellipsoid(core.mass_properties(), superellipsoid->half_axes(), superellipsoid->delta(),
                                superellipsoid->epsilon(), radius);
  }
  return quadrature_mass_properties(shape);
}

}  // namespace

MassProperties Shape::mass_properties() const { return quadrature_mass_properties(*this); }

MassProperties Sphere::mass_properties() const {
  return symmetric(kSphere * (radius_ * radius_ * radius_), Vector3::Constant(radius_ * radius_ / 5));
}

MassProperties Ellipsoid::mass_properties() const { return symmetric(kSphere * half_axes_.prod(), squares_ / 5); }

MassProperties Superellipsoid::mass_properties() const {
  // Gamma(1 + k/delta) and Gamma(1 + k/epsilon). The textbook's Gamma(3/delta) / Gamma(1/delta) is G3 / (3 G1): no poles.
  const auto d = [this](int k) { return std::tgamma(1 + k / delta_); };
  const auto e = [this](int k) { return std::tgamma(1 + k / epsilon_); };
  const double volume = 8 * half_axes_.prod() * (d(1) * d(1) / d(2)) * (e(1) * e(2) / e(3));
  const double section = d(3) * d(2) / (3 * d(1) * d(4)) * (e(4) * e(3) / (e(5) * e(2)));
  const double height = e(3) * e(3) / (3 * e(1) * e(5));
  return symmetric(volume, half_axes_.cwiseAbs2().cwiseProduct(Vector3(section, section, height)));
}

MassProperties Rounded::mass_properties() const { return swept(*this); }

}  // namespace supernormal
