// Containers that are made of walls of a scene (wall.hpp).
#pragma once

#include <vector>

#include "container.hpp"
#include "wall.hpp"

namespace falling_particles {

/// The walls of which the container is made; none for a container with geoms of its own (world/container_geoms.hpp).
std::vector<Wall> walls_in(const Container& container);

}  // namespace falling_particles
