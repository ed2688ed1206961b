#pragma once

#include <variant>

#include "container/box.hpp"
#include "container/geometry.hpp"
#include "container/hopper.hpp"
#include "container/periodic.hpp"
#include "container/terrain.hpp"

namespace falling_particles {

using Container = std::variant<Box, Hopper, Terrain, Periodic>;

/// "box", "hopper", "terrain" or "periodic": as the scene file calls it.
const char* kind_of(const Container& container);

/// The rectangle above which grains may start.
Rectangle plan_of(const Container& container);

/// The lowest z at which grains may start, m: nowhere in the container is the floor above it, the cone of a hopper excepted.
double lowest_start(const Container& container);

/// Whether nothing but air is in the cell, and above it: the cell lies within the plan and above lowest_start().
bool has_room(const Container& container, const Point& lower, const Point& size);

/// Whether a point is where the centre of a grain may be. Not a number is nowhere.
bool contains(const Container& container, const Point& point);

}  // namespace falling_particles
