// The pictures of walls: of a container, and of a scene.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "common/mesh.hpp"
#include "model/container.hpp"
#include "model/wall.hpp"

namespace falling_particles {

/// A wall of a container or of a scene, as pictures show it.
struct WallPicture {
  /// A lid vanishes when the outlet opens. A cell has a mesh of side 1, which is scaled about the origin by the side of the cell.
  /// The mesh of a moving wall is in the wall's frame.
  enum class Role { Still, Lid, Cell, Moving };

  std::string name;
  Role role;
  Mesh mesh;                                       ///< grains are on the side from which its triangles run anticlockwise
  std::vector<std::array<unsigned int, 2>> edges;  ///< vertices of the mesh, joined by lines that make the wall easier to see
  bool two_sided = false;                          ///< whether grains are on the other side, too
};

/// The pictures of a container's walls. Walls of infinite height are shown up to z = top (m). A box has none across periodic axes.
std::vector<WallPicture> pictures_of(const Container& container, double top, const PeriodicAxes& periodic = {});

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
