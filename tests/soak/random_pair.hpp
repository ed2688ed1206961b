// Random pairs of bodies.
#pragma once

#include "random.hpp"
#include "sample.hpp"

namespace supernormal::soak {

/// Two bodies of a class, or one and a shape with faces, edges or a rounding, placed on a common normal or one within the other.
void draw_random_pair(Random& random, Sample& sample);

}  // namespace supernormal::soak
