// Grains of several bodies.
#pragma once

#include <string>
#include <vector>

#include "grain_kind.hpp"

namespace falling_particles {

/// A grain of these parts, which are given in any frame: it is moved so that the centre of mass is the origin. The mass is exact:
/// the sum of the parts' closed forms where they do not overlap. What several parts share is the first one's, with its density; it
/// is found by a quadrature over lines, to about 1e-4 of its own size.
GrainKind make_compound(std::string name, std::vector<Component> components, std::string source);

}  // namespace falling_particles
