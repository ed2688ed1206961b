// Convex regions of the tangent plane of a contact, and directions in it as complex numbers.
#pragma once

#include <array>
#include <cstddef>

#include "base/tangent_plane.hpp"

namespace supernormal {

/// Coordinates in the tangent plane of a contact, about the contact point.
struct ContactFrame {
  TangentPlane plane;
  Eigen::Vector3d origin;  ///< m

  Vector2 project(const Eigen::Vector3d& point) const { return plane.project(point - origin); }
  Eigen::Vector3d lift(const Vector2& point) const { return origin + plane.lift(point); }
};

/// A convex polygon, counter-clockwise. It may be degenerate: a segment, a point or empty.
class ConvexPolygon {
 public:
  /// Two quadrangles intersect in a polygon of at most eight vertices.
  static constexpr int kCapacity = 8;

  void add(const Vector2& vertex) { vertices_[static_cast<std::size_t>(size_++)] = vertex; }
  int size() const { return size_; }
  const Vector2& operator[](int k) const { return vertices_[static_cast<std::size_t>(k)]; }

  double area() const;  ///< m^2

  /// The intersection of both. Vertices that are repeated, or inside of their neighbours by rounding, do no harm. This polygon may
  /// be a segment; the other one must have an interior.
  ConvexPolygon intersected(const ConvexPolygon& other) const;

  /// The point of the polygon nearest to a point outside. The polygon must have a vertex.
  Vector2 nearest_to(const Vector2& point) const { return nearest_to(std::array{point, point, point, point})[0]; }

  /// The same for four points.
  std::array<Vector2, 4> nearest_to(const std::array<Vector2, 4>& points) const;

 private:
  std::array<Vector2, kCapacity> vertices_;
  int size_ = 0;
};

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
