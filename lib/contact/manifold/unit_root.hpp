// Directions in a plane as complex numbers, without angles.
#pragma once

#include "base/tangent_plane.hpp"

namespace supernormal {

/// The product of two complex numbers.
inline Vector2 product(const Vector2& a, const Vector2& b) {
  return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
}

inline Vector2 fourth_power(const Vector2& z) {
  const Vector2 square = product(z, z);
  return product(square, square);
}

/// A square root of any length, with a real part that is not negative. It halves the angle, as a diagonal of a rhombus does. The
/// result is 0 if z is negative and real.
inline Vector2 direction_of_square(const Vector2& z) { return {z.x() + z.norm(), z.y()}; }

/// The unit vector within 45 degrees of the first axis whose fourth power has the direction of z, which must not be 0.
inline Vector2 direction_of_fourth_power(const Vector2& z) {
  const Vector2 square = direction_of_square(z);
  return direction_of_square(square.squaredNorm() > 0 ? square : Vector2(Vector2::UnitY())).normalized();
}

}  // namespace supernormal
