// Where the search for the best body starts from.
#pragma once

#include <vector>

#include "body.hpp"
#include "cloud.hpp"

namespace fit {

/// Bodies from which the descent may lead to the best one: attitudes from the principal axes with each of the three along the
/// body's z-axis, the section turned by half a right angle too (a square with the exponent 1.2 and one with 8, turned, look alike),
/// more attitudes where the principal moments hardly differ, round and edgy exponents; and where the best sphere's centre is
/// not that of the extents, as for data of one side only, more centres. `is_whole` says that the data are of all sides.
std::vector<Body> make_starts(const Cloud& cloud, Family family, bool is_whole);

}  // namespace fit
