// Convex regions of the tangent plane of a contact.
#pragma once

#include <array>

#include "proximity/tangent_plane.hpp"

namespace supernormal {

inline double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Coordinates in the tangent plane of a contact, about the contact point.
struct ContactFrame {
  TangentPlane plane;
  Eigen::Vector3d origin;  ///< m

  Vector2 project(const Eigen::Vector3d& point) const { return plane.project(point - origin); }
  Eigen::Vector3d lift(const Vector2& point) const { return origin + plane.lift(point); }
};

/// A convex polygon, counter-clockwise, or a degenerate one: a segment, a point, nothing.
class ConvexPolygon {
 public:
  /// Two quadrangles meet in a polygon of at most eight corners.
  static constexpr int kCapacity = 8;

  void add(const Vector2& corner) { corners_[static_cast<std::size_t>(size_++)] = corner; }
  int size() const { return size_; }
  const Vector2& operator[](int k) const { return corners_[static_cast<std::size_t>(k)]; }

  double area() const;  ///< m^2

  /// The intersection of both. A corner of one that is repeated, or inside of its neighbours by rounding, does no harm. This
  /// polygon may be a segment; the other one needs an interior.
  ConvexPolygon intersected(const ConvexPolygon& other) const;

  /// The point of the polygon that is nearest to a point outside of it. The polygon must have a corner.
  Vector2 nearest_to(const Vector2& point) const;

 private:
  std::array<Vector2, kCapacity> corners_;
  int size_ = 0;
};

}  // namespace supernormal
