// Parts in a scene that repeats along an axis.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "periodic.hpp"
#include "wall.hpp"

namespace falling_particles {

/// Takes away the first `of_container` parts, those of the container, that close the cell along its periodic axes, such as the ends
/// of a drum, and lengthens the others until they reach beyond the cell by `reach` (m).
void open_container(const PeriodicAxes& axes, double reach, std::size_t of_container, std::vector<Wall>& walls);

/// What keeps a part from being the same all along an axis on which the scene repeats: how it looks and how its surface moves.
/// Nothing when it is the same from `reach` (m) below the cell to `reach` above it, where the images of grains meet it.
std::optional<std::string> find_end(const Wall& wall, std::size_t axis, const Period& period, double reach);

}  // namespace falling_particles
