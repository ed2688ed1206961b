// The container of a scene: a box, a cell, a hopper, a terrain, a periodic cell, a moving container, or none.
#pragma once

#include <array>
#include <cmath>
#include <variant>

#include "geometry.hpp"
#include "hopper.hpp"
#include "moving.hpp"
#include "periodic.hpp"
#include "terrain.hpp"

namespace falling_particles {

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

using Container = std::variant<Box, Hopper, Terrain, Periodic, Open, Drum, Tray, ShearCell, ConveyorBelt, Cell>;

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

}  // namespace falling_particles
