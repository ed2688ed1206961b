#include "shapes/mass_properties.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"

namespace supernormal {
namespace {

constexpr double kSphere = 4 * std::numbers::pi / 3;  // volume of the unit ball

// Relative to the smallest half-extent. A thinner layer adds less than a double can hold, and products of its moments would
// underflow.
constexpr double kThinnestLayer = 0x1p-60;

/// The mass properties of a body with three planes of symmetry, from its volume and its mean squares <x^2>, <y^2>, <z^2>.
MassProperties symmetric(double volume, const Vector3& mean_squares) {
  MassProperties mass;
  mass.volume = volume;
  mass.second_moment = (volume * mean_squares).asDiagonal();
  return mass;
}

MassProperties swept_superovoid(const MassProperties& core, const Superovoid& shape, double radius) {
  const MassProperties layer = superovoid_layer(shape, radius);
  MassProperties mass = layer;
  mass.volume += core.volume;
  mass.centroid = (core.volume * core.centroid + layer.volume * layer.centroid) / mass.volume;
  mass.second_moment += core.second_moment;
  return mass;
}

/// A cylinder whose rim is rounded: at the height L + z its radius is R + s, with s^2 = r^2 - z^2.
MassProperties swept_cylinder(double R, double L, double r) {
  constexpr double kPi = std::numbers::pi;
  const double wide = (R + r) * (R + r);
  // Integrals over z from 0 to r: of (R + s)^2, of z and z^2 times it, and of (R + s)^4.
  const double square = r * (R * R + kPi / 2 * R * r + 2.0 / 3 * r * r);
  const double first = r * r * (R * R / 2 + 2.0 / 3 * R * r + r * r / 4);
  const double second = r * r * r * (R * R / 3 + kPi / 8 * R * r + 2.0 / 15 * r * r);
  const double fourth = r * (R * R * (R * R + kPi * R * r + 4 * r * r) + r * r * r * (3 * kPi / 4 * R + 8.0 / 15 * r));
  const double volume = 2 * kPi * (wide * L + square);
  const double across = kPi / 2 * (wide * wide * L + fourth) / volume;
  return symmetric(volume, {across, across, 2 * kPi * (wide * L * L * L / 3 + L * L * square + 2 * L * first + second) / volume});
}

/// A shared pointer that does not own the shape.
std::shared_ptr<const Shape> borrowed(const Shape& shape) { return {std::shared_ptr<const Shape>(), &shape}; }

/// The mass properties of the core swept by a sphere. For a core of a known class they are in closed form or by spectral
/// quadrature.
MassProperties swept(const Shape& core, double radius) {
  if (radius <= kThinnestLayer * core.half_extents().minCoeff()) return core.mass_properties();
  if (const auto* rounded = dynamic_cast<const Rounded*>(&core)) return swept(rounded->core(), rounded->radius() + radius);
  if (const auto* sphere = dynamic_cast<const Sphere*>(&core)) return Sphere(sphere->radius() + radius).mass_properties();
  if (const auto* capsule = dynamic_cast<const Capsule*>(&core)) {
    return Capsule(capsule->radius() + radius, capsule->half_length()).mass_properties();
  }
  if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&core)) {
    return swept_superovoid(core.mass_properties(), Superovoid(ellipsoid->half_axes(), 2, 2, 0, 0), radius);
  }
  if (const auto* superellipsoid = dynamic_cast<const Superellipsoid*>(&core)) {
    const Superovoid straight(superellipsoid->half_axes(), superellipsoid->delta(), superellipsoid->epsilon(), 0, 0);
    return swept_superovoid(core.mass_properties(), straight, radius);
  }
  if (const auto* superovoid = dynamic_cast<const Superovoid*>(&core)) {
    return swept_superovoid(core.mass_properties(), *superovoid, radius);
  }
  if (const auto* cylinder = dynamic_cast<const Cylinder*>(&core)) {
    return swept_cylinder(cylinder->radius(), cylinder->half_length(), radius);
  }
  if (const auto* polytope = dynamic_cast<const Polytope*>(&core)) return swept_polytope(polytope->points(), radius);
  if (const auto* box = dynamic_cast<const Box*>(&core)) {
    std::array<Vector3, 8> corners;
    for (unsigned i = 0; i < 8; ++i) {
      corners[i] =
          box->half_lengths().cwiseProduct(Vector3((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1));
    }
    return swept_polytope(corners, radius);
  }
  return quadrature_mass_properties(Rounded(borrowed(core), radius));
}

}  // namespace

MassProperties Shape::mass_properties() const { return quadrature_mass_properties(*this); }

MassProperties Sphere::mass_properties() const {
  return symmetric(kSphere * (radius_ * radius_ * radius_), Vector3::Constant(radius_ * radius_ / 5));
}

MassProperties Ellipsoid::mass_properties() const { return symmetric(kSphere * half_axes_.prod(), squares_ / 5); }

MassProperties Superellipsoid::mass_properties() const {
  // d(k) and e(k) are Gamma(1 + k/delta) and Gamma(1 + k/epsilon). The textbook's Gamma(3/delta) / Gamma(1/delta) is d(3) / (3
  // d(1)), which has no poles.
  const auto d = [this](int k) { return std::tgamma(1 + k / delta_); };
  const auto e = [this](int k) { return std::tgamma(1 + k / epsilon_); };
  const double volume = 8 * half_axes_.prod() * (d(1) * d(1) / d(2)) * (e(1) * e(2) / e(3));
  const double section = d(3) * d(2) / (3 * d(1) * d(4)) * (e(4) * e(3) / (e(5) * e(2)));
  const double height = e(3) * e(3) / (3 * e(1) * e(5));
  return symmetric(volume, half_axes_.cwiseAbs2().cwiseProduct(Vector3(section, section, height)));
}

MassProperties Superovoid::mass_properties() const {
  // The section at s = z/c is the superellipsoid's section, scaled by the polynomials X = 1 + taper_x s and Y = 1 + taper_y s. So
  // all integrals are sums of integrals of w^m s^k over s from -1 to 1, with w^epsilon = 1 - |s|^epsilon. The integrals for odd k
  // vanish.
  const auto e = [this](int k) { return std::tgamma(1 + k / epsilon_); };
  const auto integral = [&](int m, int k) { return 2 * e(m) * e(k + 1) / ((k + 1) * e(m + k + 1)); };
  const auto d = [this](int k) { return std::tgamma(1 + k / delta_); };
  const double area = 4 * d(1) * d(1) / d(2);  // area of the section with half-axes 1; mean_square: mean of x^2 in it
  const double mean_square = d(3) * d(2) / (3 * d(1) * d(4));
  const double x = taper_x_, y = taper_y_;
  // The integral of w^4 X^3 Y. Exchanging x and y gives the integral of w^4 X Y^3.
  const auto across = [&](double i, double j) {
    return integral(4, 0) + 3 * i * (i + j) * integral(4, 2) + i * i * i * j * integral(4, 4);
  };
  const double scale = area * half_axes_.prod();
  const double volume = integral(2, 0) + x * y * integral(2, 2);
  const double height = integral(2, 2) + x * y * integral(2, 4);
  MassProperties mass;
  mass.volume = scale * volume;
  mass.centroid.z() = half_axes_.z() * (x + y) * integral(2, 2) / volume;
  mass.second_moment =
      (scale * half_axes_.cwiseAbs2().cwiseProduct(Vector3(mean_square * across(x, y), mean_square * across(y, x), height)))
          .asDiagonal();
  return mass;
}

MassProperties Rounded::mass_properties() const { return swept(*core_, radius_); }

}  // namespace supernormal
