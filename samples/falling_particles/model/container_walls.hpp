// The walls of containers.
#pragma once

#include <vector>

#include "container.hpp"
#include "wall.hpp"

namespace falling_particles {

/// The walls of which the container is made. A periodic container and the container "none" have no walls.
std::vector<Wall> walls_in(const Container& container);

}  // namespace falling_particles
