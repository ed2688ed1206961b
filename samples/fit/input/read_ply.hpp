// Polygon files (.ply).
#pragma once

#include <string>

#include "read_data.hpp"

namespace fit {

/// Reads vertices, normals and polygons of a .ply file: text, or binary of either byte order. Each coordinate type is converted
/// exactly to double. Polygons are triangulated. `is_single`: whether the file has 32-bit coordinates. Throws InputError with the
/// line of a text file, or the index of the vertex or face.
Data read_ply(const std::string& path);

}  // namespace fit
