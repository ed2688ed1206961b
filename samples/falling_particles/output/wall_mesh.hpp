// What pictures show of a part.
#pragma once

#include "model/wall.hpp"
#include "observe/container_picture.hpp"

namespace falling_particles {

/// The surface of a part and its sharp edges: of one that moves in its own frame, of one that stands where it is. A plane is shown
/// as a disc around its position if it says so, otherwise as a square with sides of `extent` (m).
WallPicture picture_of(const Wall& wall, double extent);

}  // namespace falling_particles
