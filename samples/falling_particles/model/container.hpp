// The container of a scene: a box, a cell, a hopper, a terrain, a periodic cell, a drum, or none.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "geometry.hpp"
#include "hopper.hpp"
#include "terrain.hpp"
#include "wall.hpp"

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

/// A drum that rotates about the line x = 0, z = diameter / 2, from y = 0 to y = length. Its shell has `segments` flat sides around
/// a circle of `diameter`. The ends are closed and rotate with it.
struct Drum {
  double diameter;  ///< m
  double length;    ///< m
  int segments;
  double rpm;       ///< revolutions per minute; for a positive number the floor of the drum moves towards -x
  double turns_at;  ///< s

  double radius() const { return diameter / 2; }                                            ///< m
  double outer_radius() const { return radius() / std::cos(std::numbers::pi / segments); }  ///< m, of the edges

  Rectangle plan() const { return {{-radius(), 0}, {diameter, length}}; }
  double lowest() const { return 0; }
  double ceiling() const { return diameter; }
  /// Whether the box from `lower` on is within the inscribed cylinder.
  bool has_room(const Point& lower, const Point& size) const {
    const double x = std::max(std::abs(lower[0]), std::abs(lower[0] + size[0]));
    const double z = std::max(std::abs(lower[2] - radius()), std::abs(lower[2] + size[2] - radius()));
    return std::hypot(x, z) <= radius();
  }
  Region room() const {
    const double outer = outer_radius();
    return {{-outer, 0, radius() - outer}, {2 * outer, length, 2 * outer}};
  }
  bool contains(const Point& p) const { return p[1] > 0 && p[1] < length && std::hypot(p[0], p[2] - radius()) < outer_radius(); }
};

/// A floor at z = 0 and four walls of infinite height at x = 0, x = width[0], y = 0 and y = width[1].
struct Box {
  std::array<double, 2> width;  ///< m

  Rectangle plan() const { return {{0, 0}, width}; }
  double lowest() const { return 0; }
  Region room() const { return {{0, 0, 0}, {width[0], width[1], INFINITY}}; }
  bool contains(const Point& p) const { return room().contains(p); }
};

/// A container without walls. Grains start in one region. Grains that leave the other region, which contains the first, have
/// leaked.
struct Open {
  Region start;
  Region bounds;

  Rectangle plan() const { return {{start.corner[0], start.corner[1]}, {start.size[0], start.size[1]}}; }
  double lowest() const { return start.corner[2]; }
  double ceiling() const { return start.corner[2] + start.size[2]; }  ///< m; no grain starts above it
  const Region& room() const { return bounds; }
  bool contains(const Point& p) const { return bounds.contains(p); }
};

/// A box of planes that may move and be driven. Grains start in the box, and are found everywhere in front of the planes.
struct Cell : Open {
  bool has_lid() const { return std::isfinite(start.size[2]); }
};

using Container = std::variant<Box, Hopper, Terrain, Periodic, Open, Drum, Cell>;

/// The name in the scene file: "box", "hopper", …
const char* kind_of(const Container& container);

/// The rectangle above which grains may start.
Rectangle plan_of(const Container& container);

/// Whether walls and bounds are apart: grains may fall to parts far below the lowest start, or past all of them.
bool is_open(const Container& container);

/// m, the lowest z at which grains may start. Except for a hopper's cone, the floor is nowhere above it.
double lowest_start(const Container& container);

/// m, the z below which all grains start; infinite if there is no such limit.
double ceiling_of(const Container& container);

/// Whether the cell and the space above it are free of walls. The cell must lie within the plan and above lowest_start().
bool has_room(const Container& container, const Point& lower, const Point& size);

/// The smallest box around all points for which contains() is true. It has no upper side where the container is open above. Of a
/// periodic container it is the cell.
Region room_of(const Container& container);

/// Whether a point may be the centre of a grain. False for a NaN.
bool contains(const Container& container, const Point& point);

/// The walls of which the container is made. A periodic container and the container "none" have no walls.
std::vector<Wall> walls_in(const Container& container);

}  // namespace falling_particles
