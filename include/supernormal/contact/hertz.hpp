// Hertz's contact of two elastic bodies, in dimensionless formulas.
#pragma once

#include "supernormal/export.h"

namespace supernormal {

/// F2 of Johnson, Contact Mechanics, section 4.2(c): the depth of an elliptic contact over the depth of a round contact with the
/// radius sqrt(R' R''). `ratio` = R'/R'' >= 1 is the ratio of the principal relative radii, ContactCurvature::larger over
/// ContactCurvature::smaller. The result is in (0, 1].
SUPERNORMAL_API double hertz_correction(double ratio);

/// The b of a damper 2 b sqrt(5/6 m dF/ddepth), with which an impact of the mass m at any velocity returns the fraction
/// `restitution`, in [0.05, 1], of the velocity. The contact ends when its force would become a pull. The function integrates
/// impacts, which takes 1 ms.
SUPERNORMAL_API double hertz_damping_ratio(double restitution);

}  // namespace supernormal
