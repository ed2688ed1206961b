// The container of a scene: a box, a hopper, a terrain, a periodic cell, a moving container, or none.
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

/// m, the lowest z at which grains may start. Except for a hopper's cone, the floor is nowhere above it.
double lowest_start(const Container& container);

/// m, the z below which all grains start; infinite if there is no such limit.
double ceiling_of(const Container& container);

/// Whether the cell and the space above it are free of walls. The cell must lie within the plan and above lowest_start().
bool has_room(const Container& container, const Point& lower, const Point& size);

/// Whether a point may be the centre of a grain. False for a NaN.
bool contains(const Container& container, const Point& point);

}  // namespace falling_particles
