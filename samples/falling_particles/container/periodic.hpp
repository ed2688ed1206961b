// A container without walls: a cell that repeats in all directions.
#pragma once

#include <array>
#include <cmath>

#include "container/geometry.hpp"

namespace falling_particles {

/// A cube from the origin that repeats for ever in all directions: a grain that leaves on one side enters on the other.
struct Periodic {
  double side;  ///< m, at the start

  Rectangle plan() const { return {{0, 0}, {side, side}}; }
  double lowest() const { return 0; }
  /// Every finite point is inside.
  bool contains(const Point& p) const { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }
};

}  // namespace falling_particles
