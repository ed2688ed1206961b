// The container of a scene: a box, a hopper, a terrain, a periodic cell, one that moves, or none.
#pragma once

#include <variant>

#include "box.hpp"
#include "geometry.hpp"
#include "hopper.hpp"
#include "moving.hpp"
#include "open.hpp"
#include "periodic.hpp"
#include "terrain.hpp"

namespace falling_particles {

using Container = std::variant<Box, Hopper, Terrain, Periodic, Open, Drum, Tray, ShearCell, ConveyorBelt>;

/// The name in the scene file: "box", "hopper", …
const char* kind_of(const Container& container);

/// The rectangle above which grains may start.
Rectangle plan_of(const Container& container);

/// The lowest z at which grains may start, m: nowhere in the container is the floor above it, except for the cone of a hopper.
double lowest_start(const Container& container);

/// The z below which all grains start, m; infinite where there is no such limit.
double ceiling_of(const Container& container);

/// Whether there is only air in the cell and above it: the cell lies within the plan and above lowest_start().
bool has_room(const Container& container, const Point& lower, const Point& size);

/// Whether a point may be the centre of a grain. False for a NaN.
bool contains(const Container& container, const Point& point);

}  // namespace falling_particles
