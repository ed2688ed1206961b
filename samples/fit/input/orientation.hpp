// Orients triangles outwards.
#pragma once

#include <cstddef>

#include "read_data.hpp"

namespace fit {

/// The changes to a mesh.
struct Oriented {
  std::size_t removed = 0;  ///< triangles with coincident vertices, or with the vertices of an earlier triangle
  std::size_t turned = 0;   ///< triangles that faced inwards
};

/// Orients all triangles of a welded mesh outwards. Neighbours get the same orientation. Each connected part is oriented by the
/// sign of its volume. A part inside another one is a cavity and is oriented together with it. Removes triangles with coincident
/// vertices. Of two triangles with the same vertices (a two-sided mesh) it removes the second.
Oriented orient(Data& data);

}  // namespace fit
