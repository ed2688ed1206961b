// Method 2: the common normal in the angles of both surfaces.
#pragma once

#include "start.hpp"

namespace literature {

/// Newton's method for the latitude and longitude of both points, with an analytic Jacobian. The normal of body 1 and the line
/// between the points are perpendicular to both tangents of body 2 (the parametric form of Goncalves et al. 2017).
CommonNormal common_normal_angles(const Bodies& bodies, const Options& options, Start start);

}  // namespace literature
