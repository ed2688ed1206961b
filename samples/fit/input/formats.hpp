// The formats of files that read_data() reads itself.
#pragma once

#include <string>

#include "read_data.hpp"

namespace fit {

/// Reads vertices, normals and polygons of a .ply file: text, or binary of either byte order. Each coordinate type is converted
/// exactly to double. Polygons are triangulated. `is_single`: whether the file has 32-bit coordinates. Throws InputError with the
/// line of a text file, or the index of the vertex or face.
Data read_ply(const std::string& path);

/// Reads vertices and polygons of a text .off file, or vertices with normals alone (NOFF). A line has one vertex or one polygon;
/// the numbers behind them, such as colours, are not read. Throws InputError with the line.
Data read_off(const std::string& path);

}  // namespace fit
