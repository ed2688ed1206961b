// Hertz's contact of two elastic bodies, in formulas without units.
#pragma once

#include "supernormal/export.h"

namespace supernormal {

/// F2 of Johnson, Contact Mechanics, section 4.2(c): the ratio by which the depth of an elliptic contact is smaller than that of
/// a round one with the radius sqrt(R' R''); `ratio` = R'/R'' >= 1 is that of the principal relative radii, the larger value of
/// ContactCurvature over the smaller. The result is in (0, 1].
SUPERNORMAL_API double hertz_correction(double ratio);

/// The b of a damper 2 b sqrt(5/6 m dF/ddepth) for which an impact of the mass m ends with `restitution` (in [0.05, 1]) of its
/// velocity, if the contact ends as soon as it would have to pull. The same at every velocity. It integrates impacts: 1 ms.
SUPERNORMAL_API double hertz_damping_ratio(double restitution);

}  // namespace supernormal
