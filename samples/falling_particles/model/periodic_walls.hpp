// Walls of a scene that repeats along an axis.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "periodic.hpp"
#include "wall.hpp"

namespace falling_particles {

/// Of the first `of_container` walls, the container's, removes those that close the cell along its periodic axes, such as the ends
/// of a drum. Lengthens the others until they extend beyond the cell by `reach` (m).
void open_container(const PeriodicAxes& axes, double reach, std::size_t of_container, std::vector<Wall>& walls);

/// The reason why a wall is not uniform along a periodic axis: its shape or its motion. Empty if the wall is uniform from `reach`
/// (m) below the cell to `reach` above it, where the images of grains meet it.
std::optional<std::string> find_end(const Wall& wall, std::size_t axis, const Period& period, double reach);

}  // namespace falling_particles
