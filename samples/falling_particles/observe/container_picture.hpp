// What a picture shows of a container.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/container.hpp"

namespace falling_particles {

/// A piece of a container.
struct WallPicture {
  /// A lid vanishes when the outlet opens; a cell, whose mesh has the side 1, is scaled about the origin by its side; the mesh of
  /// what moves is in its own frame.
  enum class Role { Still, Lid, Cell, Moving };

  std::string name;
  Role role;
  Mesh mesh;                                       ///< bodies are on the side from which its triangles run anticlockwise
  std::vector<std::array<unsigned int, 2>> edges;  ///< of vertices of the mesh, where a line makes the part easier to see
  bool two_sided = false;                          ///< whether bodies are on the other side, too
};

/// The parts of a container. Walls without upper end are shown up to z = top (m); a box has none across periodic axes.
std::vector<WallPicture> pictures_of(const Container& container, double top, const PeriodicAxes& periodic = {});

}  // namespace falling_particles
