// The walls of a container in pictures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/mesh.hpp"
#include "model/container.hpp"

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

}  // namespace falling_particles
