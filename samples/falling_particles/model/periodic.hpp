// Periodic boundaries: a periodic container without walls, and periodic axes of other scenes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry.hpp"

namespace falling_particles {

/// The interval of an axis after which a scene repeats.
struct Period {
  double lower;   ///< m
  double length;  ///< m

  double upper() const { return lower + length; }                                           ///< m
  double middle() const { return lower + length / 2; }                                      ///< m
  double wrapped(double x) const { return x - length * std::floor((x - lower) / length); }  ///< m, the image of x in the cell
};

/// The periods along x, y and z; empty where a scene does not repeat.
using PeriodicAxes = std::array<std::optional<Period>, 3>;

inline bool is_any(const PeriodicAxes& axes) {
  return std::ranges::any_of(axes, [](const std::optional<Period>& period) { return period.has_value(); });
}

/// The image of the point in the cell.
inline Point wrapped(const PeriodicAxes& axes, Point point) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axes[axis]) point[axis] = axes[axis]->wrapped(point[axis]);
  }
  return point;
}

/// A cube with a corner at the origin that repeats in all directions: a grain that leaves on one side enters on the other.
struct Periodic {
  double side;  ///< m, at the start

  Rectangle plan() const { return {{0, 0}, {side, side}}; }
  double lowest() const { return 0; }
  Region room() const { return {{0, 0, 0}, {side, side, side}}; }
  /// Contains every finite point.
  bool contains(const Point& p) const { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }
};

}  // namespace falling_particles
