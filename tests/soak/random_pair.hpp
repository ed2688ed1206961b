// Random pairs of bodies.
#pragma once

#include <span>

#include "random.hpp"
#include "sample.hpp"
#include "solvers/superellipsoid_classes.hpp"

namespace supernormal::soak {

/// Two bodies of one of the classes, or one and a shape with faces, edges or a rounding, placed on a common normal or one within
/// the other.
void draw_random_pair(Random& random, std::span<const test::SuperellipsoidClass> classes, Sample& sample);

}  // namespace supernormal::soak
