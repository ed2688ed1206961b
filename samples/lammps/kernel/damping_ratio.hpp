// The damping of a linear spring that makes an impact lose what it should.
#pragma once

namespace granular {

/// The share b of critical damping, 2 b sqrt(k m), with which an impact on a linear spring ends with `restitution` (in (0, 1]) of
/// its velocity, if the contact ends as soon as it would have to pull (Schwager and Poeschel, Granular Matter 9, 465 (2007)). The
/// same at every velocity.
double hooke_damping_ratio(double restitution);

}  // namespace granular
