// The meshes of walls.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "container_picture.hpp"
#include "model/wall.hpp"

namespace falling_particles {

using Box3 = Eigen::AlignedBox3d;  // m, in the world's frame

/// The surface of a wall and its sharp edges, for a moving wall in its own frame, for a standing wall in the world's. A plane is a
/// disc around its position if it has a shown_radius, otherwise the rectangle on which `region` stands, seen along its normal.
WallPicture picture_of(const Wall& wall, const Box3& region);

/// What planes are drawn below: `contents`, up to the planes that face them across the axes of the world, and half as much again
/// where there is none.
Box3 region_of_planes(Box3 contents, std::span<const Wall> walls);

struct SurfacePoint {
  Vector3 position;  ///< m
  Vector3 normal;    ///< unit
};

/// The vertices of the triangles of a wall at its start, in the world's frame, three by three. A plane is as wide as the diagonal
/// of the container's plan.
std::vector<SurfacePoint> surface_of(const Wall& wall, const Container& container);

}  // namespace falling_particles
