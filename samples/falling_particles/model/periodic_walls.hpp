// Walls of a scene that repeats along an axis.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "container.hpp"
#include "wall.hpp"

namespace falling_particles {

/// Opens a container along its periodic axes. The first `of_container` walls are the container's. Walls that close the cell, such
/// as the ends of a drum, are removed. A drum is lengthened until it extends beyond the cell by `reach` (m).
void open_container(const PeriodicAxes& axes, double reach, std::size_t of_container, std::vector<Wall>& walls);

/// The reason why a wall is not uniform along a periodic axis: its shape or its motion. Empty if the wall is uniform from `reach`
/// (m) below the cell to `reach` above it. Images of grains meet the wall there.
std::optional<std::string> find_end(const Wall& wall, std::size_t axis, const Period& period, double reach);

}  // namespace falling_particles
