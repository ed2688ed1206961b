// Directions in a plane as complex numbers, without angles.
#pragma once

#include "proximity/tangent_plane.hpp"

namespace supernormal {

/// The product of two complex numbers.
inline Vector2 product(const Vector2& a, const Vector2& b) {
  return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
}

inline Vector2 fourth_power(const Vector2& z) {
  const Vector2 square = product(z, z);
  return product(square, square);
}

/// The root with a positive real part of a complex number of length 1.
inline Vector2 unit_root(const Vector2& z) {
  return z.x() > -1 ? Vector2(z + Vector2::UnitX()).normalized() : Vector2(Vector2::UnitY());
}

/// The direction within 45 degrees of the first axis whose fourth power has that of z, which must not be 0.
inline Vector2 direction_of_fourth_power(const Vector2& z) { return unit_root(unit_root(z / z.norm())); }

}  // namespace supernormal
