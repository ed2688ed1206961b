// Convex regions of the tangent plane of a contact.
#pragma once

#include <array>

#include "solvers/tangent_plane.hpp"

namespace supernormal {

/// Coordinates in the tangent plane of a contact, about the contact point.
struct PatchFrame {
  TangentPlane plane;
  Eigen::Vector3d origin;  ///< m

  Vector2 project(const Eigen::Vector3d& point) const { return plane.project(point - origin); }
};

/// A convex polygon, counter-clockwise, or what is left of one: a segment, a point, nothing.
class Footprint {
 public:
  /// Two octagons meet in a polygon of at most sixteen corners.
  static constexpr int kCapacity = 16;

  void add(const Vector2& corner) { corners_[static_cast<std::size_t>(size_++)] = corner; }
  int size() const { return size_; }
  const Vector2& operator[](int k) const { return corners_[static_cast<std::size_t>(k)]; }

  /// What both have in common. A corner of one that is repeated, or inside of its neighbours by rounding, does no harm.
  Footprint intersected(const Footprint& other) const;

  struct Range {
    double low = 0;
    double high = 0;
    double width() const { return high - low; }
  };

  /// The least and the greatest coordinate along a unit vector. There must be a corner.
  Range range(const Vector2& direction) const;

  /// The corners of a large quadrangle: the two that are farthest apart, then the farthest on either side of the line through them,
  /// if there are any.
  Footprint quadrangle() const;

 private:
  std::array<Vector2, kCapacity> corners_;
  int size_ = 0;
};

}  // namespace supernormal
