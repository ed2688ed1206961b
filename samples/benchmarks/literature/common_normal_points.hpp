// Method 1: the common normal of two implicit functions.
#pragma once

#include "start.hpp"

namespace literature {

/// Newton's method for the six coordinates of two points. Both are on their surfaces. The normal of body 1 and the line between the
/// points are perpendicular to both tangents of body 2 (Lopes, Silva, Ambrosio, Flores 2010; Goncalves, Bernardino, Jorge, Lopes
/// 2017). The Jacobian is analytic, as in the first of the two papers.
CommonNormal common_normal_points(const Bodies& bodies, const Options& options, Start start);

}  // namespace literature
