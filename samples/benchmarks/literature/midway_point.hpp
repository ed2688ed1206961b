// Method 3: the midway point of discrete element codes.
#pragma once

#include "method.hpp"

namespace literature {

/// The point with F1 = F2 and opposite gradients (Houlsby 2009), by Newton's method for its three coordinates and a multiplier,
/// with a line search. The first bodies are spheres, whose answer is known; radii and exponents go to those of the bodies in ten
/// steps or more (Podlozhnyuk, Pirker, Kloss 2017). The bodies overlap if the point is inside both. The depth is then the distance
/// of the surfaces along the common gradient through the point, which is not the shortest: by its definition the answer differs
/// from the gap.
CommonNormal midway_point(const Bodies& bodies, const Options& options);

}  // namespace literature
