#include "superquadric.hpp"

#include <algorithm>
#include <cmath>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace literature {
namespace {

// Replaces a coordinate of zero: its negative powers are then large but finite, and their products with zero are not NaN.
constexpr double kLeast = 1e-150;

/// x^exponent for x >= 0. Small integer powers avoid the C library, which would slow down the ellipsoids.
double power(double x, double exponent) {
  if (exponent == 0) return 1;
  if (exponent == 1) return x;
  if (exponent == 2) return x * x;
  return std::pow(std::max(x, kLeast), exponent);
}

double signed_power(double x, double exponent) { return std::copysign(power(std::abs(x), exponent), x); }

/// The signed powers of the sine and cosine of an angle, and their derivatives.
struct AngleJet {
  double cosine, sine, cosine_rate, sine_rate;

  AngleJet(double cosine_of, double sine_of, double exponent)
      : cosine(signed_power(cosine_of, exponent)),
        sine(signed_power(sine_of, exponent)),
        cosine_rate(-exponent * cosine * sine_of / away_from_zero(cosine_of)),
        sine_rate(exponent * sine * cosine_of / away_from_zero(sine_of)) {}

 private:
  static double away_from_zero(double x) { return std::copysign(std::max(std::abs(x), kLeast), x); }
};

/// The product of a latitude jet and a longitude jet, times lengths: a vector and its derivatives.
void multiply(const AngleJet& latitude, const AngleJet& longitude, const Vector3& lengths, Vector3& vector, Matrix32& rate) {
  vector = {latitude.cosine * longitude.cosine, latitude.cosine * longitude.sine, latitude.sine};
  rate.col(0) << latitude.cosine_rate * longitude.cosine, latitude.cosine_rate * longitude.sine, latitude.sine_rate;
  rate.col(1) << latitude.cosine * longitude.cosine_rate, latitude.cosine * longitude.sine_rate, 0;
  vector = vector.cwiseProduct(lengths);
  rate = lengths.asDiagonal() * rate;
}

}  // namespace

std::optional<Superquadric> Superquadric::of(const supernormal::Shape& shape) {
  if (const auto* const body = dynamic_cast<const supernormal::Superellipsoid*>(&shape))
    return Superquadric{body->half_axes(), body->delta(), body->epsilon()};
  if (dynamic_cast<const supernormal::Ellipsoid*>(&shape) != nullptr) return Superquadric{shape.half_extents(), 2, 2};
  return std::nullopt;
}

double Superquadric::value(const Vector3& x) const {
  const Vector3 u = x.cwiseQuotient(half_axes).cwiseAbs();
  return power(power(u.x(), delta) + power(u.y(), delta), epsilon / delta) + power(u.z(), epsilon) - 1;
}

Implicit Superquadric::implicit(const Vector3& x) const {
  const Vector3 v = x.cwiseQuotient(half_axes);
  const Vector3 u = v.cwiseAbs().cwiseMax(kLeast);
  // Start with the second derivatives: each further power is a product.
  const double x2 = power(u.x(), delta - 2), y2 = power(u.y(), delta - 2), z2 = power(u.z(), epsilon - 2);
  const double sum = x2 * u.x() * u.x() + y2 * u.y() * u.y();
  const double outer2 = delta == epsilon ? 1 / std::max(sum, kLeast) : std::pow(std::max(sum, kLeast), epsilon / delta - 2);
  const double outer1 = outer2 * sum;
  const double x1 = x2 * v.x(), y1 = y2 * v.y(), z1 = z2 * v.z();
  const Vector3 inverse = half_axes.cwiseInverse();
  const double mixed = (epsilon - delta) * outer2;
  Implicit result;
  result.value = outer1 * sum + z1 * v.z() - 1;
  result.gradient = epsilon * Vector3(outer1 * x1, outer1 * y1, z1).cwiseProduct(inverse);
  result.hessian << mixed * x1 * x1 + (delta - 1) * outer1 * x2, mixed * x1 * y1, 0,  //
      mixed * x1 * y1, mixed * y1 * y1 + (delta - 1) * outer1 * y2, 0,                //
      0, 0, (epsilon - 1) * z2;
  result.hessian = epsilon * (inverse.asDiagonal() * result.hessian * inverse.asDiagonal());
  return result;
}

SurfacePoint Superquadric::surface(const Vector2& angles) const {
  const double cos1 = std::cos(angles[0]), sin1 = std::sin(angles[0]), cos2 = std::cos(angles[1]), sin2 = std::sin(angles[1]);
  SurfacePoint result;
  multiply({cos1, sin1, 2 / epsilon}, {cos2, sin2, 2 / delta}, half_axes, result.point, result.point_rate);
  multiply({cos1, sin1, 2 - 2 / epsilon}, {cos2, sin2, 2 - 2 / delta}, half_axes.cwiseInverse(), result.normal, result.normal_rate);
  return result;
}

Vector3 Superquadric::point(const Vector2& angles) const {
  const double across = signed_power(std::cos(angles[0]), 2 / epsilon);
  return half_axes.cwiseProduct(Vector3(across * signed_power(std::cos(angles[1]), 2 / delta),
                                        across * signed_power(std::sin(angles[1]), 2 / delta),
                                        signed_power(std::sin(angles[0]), 2 / epsilon)));
}

Vector2 Superquadric::angles_of(const Vector3& normal) const {
  const Vector3 m = normal.cwiseProduct(half_axes);
  const double inner = 2 - 2 / delta, outer = 2 - 2 / epsilon;
  const double longitude = std::atan2(signed_power(m.y(), 1 / inner), signed_power(m.x(), 1 / inner));
  const double cosine = std::cos(longitude), sine = std::sin(longitude);
  const double across = std::abs(cosine) > std::abs(sine) ? m.x() / signed_power(cosine, inner) : m.y() / signed_power(sine, inner);
  return {std::atan2(signed_power(m.z(), 1 / outer), signed_power(across, 1 / outer)), longitude};
}

}  // namespace literature
