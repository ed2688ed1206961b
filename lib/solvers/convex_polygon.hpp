// Convex polygons of a few corners, and their parts.
#pragma once

#include <array>
#include <cstddef>

namespace supernormal {

/// The corners in order, or what is left of one: a segment, a point, nothing. Never more than kCapacity; further ones are left out.
template <typename Point, std::size_t kCapacity>
class ConvexPolygon {
 public:
  void add(const Point& corner) {
    if (count_ < kCapacity) corners_[count_++] = corner;
  }

  std::size_t size() const { return count_; }
  const Point& operator[](std::size_t k) const { return corners_[k]; }
  const Point* begin() const { return corners_.data(); }
  const Point* end() const { return corners_.data() + count_; }

  /// Leaves the part where the affine function side(point) >= 0 (Sutherland and Hodgman 1974). A corner that is repeated, or inside
  /// of its neighbours by rounding, does no harm.
  template <typename Side>
  void clip(const Side& side) {
    std::array<double, kCapacity> sides;
    bool is_whole = true;
    for (std::size_t k = 0; k < count_; ++k) {
      sides[k] = side(corners_[k]);
      is_whole = is_whole && sides[k] >= 0;
    }
    if (is_whole) return;
    ConvexPolygon rest;
    for (std::size_t k = 0; k < count_; ++k) {
      const std::size_t next = k + 1 == count_ ? 0 : k + 1;
      if (sides[k] >= 0) rest.add(corners_[k]);
      if ((sides[k] > 0 && sides[next] < 0) || (sides[k] < 0 && sides[next] > 0)) {
        rest.add(corners_[k] + sides[k] / (sides[k] - sides[next]) * (corners_[next] - corners_[k]));
      }
    }
    *this = rest;
  }

 private:
  std::array<Point, kCapacity> corners_;
  std::size_t count_ = 0;
};

}  // namespace supernormal
