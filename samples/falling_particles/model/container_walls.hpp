// Containers that are made of parts.
#pragma once

#include <vector>

#include "container.hpp"
#include "wall.hpp"

namespace falling_particles {

/// The parts of which the container is made; none for one with walls of its own.
std::vector<Wall> walls_in(const Container& container);

}  // namespace falling_particles
