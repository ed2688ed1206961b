// Starts of the search for the best body.
#pragma once

#include <vector>

#include "body.hpp"
#include "cloud.hpp"

namespace fit {

/// Bodies from which a descent may lead to the best one:
/// - orientations from the principal axes, with each of the three as z;
/// - the same with the section rotated by 45 degrees: exponents 1.2 and 8 look alike after this rotation;
/// - more orientations if principal moments are similar;
/// - round and edgy exponents;
/// - more centres if the centre of the best sphere differs from the centre of the extents, as in one-sided data.
/// `is_whole`: the data cover all sides.
std::vector<Body> make_starts(const Cloud& cloud, Family family, bool is_whole);

}  // namespace fit
