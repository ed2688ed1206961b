// The meshes of walls.
#pragma once

#include <vector>

#include "container_picture.hpp"
#include "model/wall.hpp"

namespace falling_particles {

/// The surface of a wall and its sharp edges, for a moving wall in its own frame, for a standing wall in the world's. A plane is a
/// disc around its position if it has a shown_radius, otherwise a square with sides of `extent` (m).
WallPicture picture_of(const Wall& wall, double extent);

struct SurfacePoint {
  Vector3 position;  ///< m
  Vector3 normal;    ///< unit
};

/// The vertices of the triangles of a wall at its start, in the world's frame, three by three. A plane is as wide as the diagonal
/// of the container's plan.
std::vector<SurfacePoint> surface_of(const Wall& wall, const Container& container);

}  // namespace falling_particles
