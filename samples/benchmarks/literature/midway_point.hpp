// Method 3: the midway point of discrete element codes.
#pragma once

#include "method.hpp"

namespace literature {

/// The point with F1 = F2 and opposite gradients (Houlsby 2009), by Newton's method for its coordinates and a multiplier, with a
/// line search. The first bodies are spheres, whose solution is known. Radii and exponents change to the real ones in at least ten
/// stages (Podlozhnyuk, Pirker, Kloss 2017). The bodies overlap if the point is inside both. The depth is then the distance of the
/// surfaces along the common gradient through the point. It is not the shortest distance, so the result differs from the gap by
/// definition.
CommonNormal midway_point(const Bodies& bodies, const Options& options);

}  // namespace literature
