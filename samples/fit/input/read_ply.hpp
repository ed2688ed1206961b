// Polygon files (.ply).
#pragma once

#include <string>

#include "read_data.hpp"

namespace fit {

/// Reads vertices, their normals and the polygons of a .ply: text or binary of either byte order, coordinates of any type, each as
/// the double that it is. A polygon is cut into triangles. `is_single` says whether the file holds its coordinates in 32 bits.
/// Throws InputError, which names the line of a text or the number of the vertex or face.
Data read_ply(const std::string& path);

}  // namespace fit
