// Compounds: grains of several convex bodies.
#pragma once

#include <string>
#include <vector>

#include "grain_kind.hpp"

namespace falling_particles {

/// Makes a kind of grain of these components, which may be given in any frame. The result is moved so that its centre of mass is
/// the origin. The mass is exact, by closed forms, where components do not overlap. Volume that several components share belongs to
/// the first one, with its density. A quadrature over lines integrates the shared volume to about 1e-4 of its size.
GrainKind make_compound(std::string name, std::vector<Component> components, std::string source);

}  // namespace falling_particles
