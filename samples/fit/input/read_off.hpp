// Object files (.off).
#pragma once

#include <string>

#include "read_data.hpp"

namespace fit {

/// Reads vertices and polygons of a text .off file, or vertices with normals alone (NOFF). A line has one vertex or one polygon;
/// the numbers behind them, such as colours, are not read. Throws InputError with the line.
Data read_off(const std::string& path);

}  // namespace fit
