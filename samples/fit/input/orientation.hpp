// Triangles that face outwards.
#pragma once

#include <cstddef>

#include "read_data.hpp"

namespace fit {

/// What was done to a mesh.
struct Oriented {
  std::size_t removed = 0;  ///< triangles without three corners, or with those of an earlier one
  std::size_t turned = 0;   ///< triangles that faced inwards
};

/// Makes all triangles of a welded mesh face outwards: neighbours alike, and each connected part by the volume that it encloses. A
/// part that lies in another one is a cavity, and is turned round with that alone. Triangles without three corners go, and of two
/// with the same corners (a mesh with two sides) the second.
Oriented orient(Data& data);

}  // namespace fit
