// Removes the plane on which a scanned object stands.
#pragma once

#include <string>

#include "read_data.hpp"

namespace fit {

/// Removes the points or triangles of a table, and returns a sentence for the user; "" if there is none.
///
/// A table is a plane with at least 15 % of the points. All other points lie on one side of it. A fifth of its own points lie
/// beyond the circle around the object's projection: so the face of a box and the base of a bust are no tables. The plane is found
/// by random sampling (RANSAC, Fischler and Bolles 1981), always with the same samples.
std::string remove_table(Data& data);

}  // namespace fit
