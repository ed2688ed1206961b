// Axes, points and regions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace falling_particles {

/// An axis of the world frame.
enum class Axis { X, Y, Z };

inline const char* name_of(Axis axis) { return axis == Axis::X ? "x" : axis == Axis::Y ? "y" : "z"; }

using Point = std::array<double, 3>;  ///< m

/// A rectangle in the xy-plane with sides along x and y.
struct Rectangle {
  std::array<double, 2> corner;  ///< m, the corner with the lowest x and y
  std::array<double, 2> width;   ///< m, along x and y

  /// The border is not inside.
  bool contains(double x, double y) const {
    return x > corner[0] && x < corner[0] + width[0] && y > corner[1] && y < corner[1] + width[1];
  }
};

/// A box with sides along the axes.
struct Region {
  Point corner;  ///< m, the corner with the lowest x, y and z
  Point size;    ///< m

  /// The border is not inside.
  bool contains(const Point& p) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(p[i] > corner[i] && p[i] < corner[i] + size[i])) return false;
    }
    return true;
  }
};

}  // namespace falling_particles
