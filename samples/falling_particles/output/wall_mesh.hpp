// The mesh of a wall in pictures.
#pragma once

#include "model/wall.hpp"
#include "observe/container_picture.hpp"

namespace falling_particles {

/// The surface of a wall and its sharp edges, for a moving wall in its own frame, for a standing wall in the world's. A plane is a
/// disc around its position if it has a shown_radius, otherwise a square with sides of `extent` (m).
WallPicture picture_of(const Wall& wall, double extent);

}  // namespace falling_particles
