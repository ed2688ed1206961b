// A container without walls of its own: the walls of the scene hold the grains.
#pragma once

#include <array>

#include "geometry.hpp"

namespace falling_particles {

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

/// A container without walls. Grains start in one region. Grains that leave the other region, which contains the first, have
/// leaked.
struct Open {
  Region start;
  Region bounds;

  Rectangle plan() const { return {{start.corner[0], start.corner[1]}, {start.size[0], start.size[1]}}; }
  double lowest() const { return start.corner[2]; }
  double ceiling() const { return start.corner[2] + start.size[2]; }  ///< m; no grain starts above it
  bool contains(const Point& p) const { return bounds.contains(p); }
};

}  // namespace falling_particles
