#pragma once

#include <array>
#include <cmath>

#include "container/geometry.hpp"

namespace falling_particles {

/// A cube from the origin that goes on for ever in all directions: what leaves on one side enters on the other. No walls.
struct Periodic {
  double side;  ///< m, at the start

  Rectangle plan() const { return {{0, 0}, {side, side}}; }
  double lowest() const { return 0; }
  /// Everywhere is inside, as far as it is anywhere.
  bool contains(const Point& p) const { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }
};

}  // namespace falling_particles
