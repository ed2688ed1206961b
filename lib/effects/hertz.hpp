// Hertz's contact of two elastic bodies, as numbers.
#pragma once

namespace supernormal::effects {

/// F2 of Johnson, Contact Mechanics, section 4.2(c): what the depth of an elliptic contact is shorter by than that of a round one
/// with the radius sqrt(R' R''); `ratio` = R'/R'' >= 1 of the principal relative radii. In (0, 1].
double hertz_correction(double ratio);

/// The b of 2 b sqrt(5/6 m dF/ddepth) for which an impact ends with `restitution` (in (0, 1]) of its velocity, where the contact
/// lets go as soon as it would have to pull.
double hertz_damping_ratio(double restitution);

}  // namespace supernormal::effects
