// The damping of a linear spring for a given restitution.
#pragma once

namespace granular {

/// The damping ratio b, in 2 b sqrt(k m), of a linear spring that gives an impact this restitution, in (0, 1]. The contact ends as
/// soon as its force would become attractive (Schwager and Poeschel, Granular Matter 9, 465 (2007)). The ratio does not depend on
/// the velocity.
double hooke_damping_ratio(double restitution);

}  // namespace granular
