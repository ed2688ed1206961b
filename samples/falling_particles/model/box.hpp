// A box into which grains fall.
#pragma once

#include <array>
#include <cmath>

#include "geometry.hpp"

namespace falling_particles {

/// A floor at z = 0 and four walls of infinite height at x = 0, x = width[0], y = 0 and y = width[1].
struct Box {
  std::array<double, 2> width;  ///< m

  Rectangle plan() const { return {{0, 0}, width}; }
  double lowest() const { return 0; }
  bool contains(const Point& p) const { return plan().contains(p[0], p[1]) && p[2] > 0 && p[2] < INFINITY; }
};

}  // namespace falling_particles
