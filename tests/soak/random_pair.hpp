// Random pairs of bodies.
#pragma once

#include <span>

#include "random.hpp"
#include "sample.hpp"
#include "support/superellipsoid_classes.hpp"

namespace supernormal::soak {

/// Draws two bodies of one of the classes, or one body and a shape with faces, edges or a rounding. They have a common normal, or
/// one is inside the other. With `mixes_exponents` only the half-axes are of one class, and each exponent is of any class.
void draw_random_pair(Random& random, std::span<const test::SuperellipsoidClass> classes, bool mixes_exponents, Sample& sample);

}  // namespace supernormal::soak
