// Polygons of files.
#pragma once

#include <span>
#include <string>

#include "read_data.hpp"

namespace fit {

/// Adds a polygon, as triangles, to the vertices that are read. `corners` are indices from 0, as the file has them. Polygons with
/// fewer than three vertices have no area and are left out. Returns what is wrong with the polygon; "": nothing.
std::string append_polygon(std::span<const double> corners, Data& data);

}  // namespace fit
