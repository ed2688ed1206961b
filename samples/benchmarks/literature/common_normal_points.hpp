// Method 1: the common normal of two implicit functions.
#pragma once

#include "start.hpp"

namespace literature {

/// Newton's method for the six coordinates of two points: both on their surfaces, the normal of body 1 across both tangents of
/// body 2, and so the line between the points (Lopes, Silva, Ambrosio, Flores 2010; Goncalves, Bernardino, Jorge, Lopes 2017). The
/// Jacobian is analytic, as it is in the first of the two.
CommonNormal common_normal_points(const Bodies& bodies, const Options& options, Start start);

}  // namespace literature
