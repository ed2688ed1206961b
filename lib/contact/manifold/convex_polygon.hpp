// Convex regions of the tangent plane of a contact.
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
  Vector2 nearest_to(const Vector2& point) const { return nearest_to(std::array<Vector2, 1>{point})[0]; }

  /// The same for one or four points.
  template <std::size_t kCount>
  std::array<Vector2, kCount> nearest_to(const std::array<Vector2, kCount>& points) const;

 private:
  std::array<Vector2, kCapacity> vertices_;
  int size_ = 0;
};

}  // namespace supernormal
