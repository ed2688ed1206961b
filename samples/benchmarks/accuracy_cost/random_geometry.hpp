// Random normals and orientations.
#pragma once

#include "base/random.hpp"
#include "supernormal/shapes/shape.hpp"

namespace accuracy_cost {

double uniform(falling_particles::Random& random, double low, double high);

/// A unit vector, uniform on the sphere.
supernormal::Vector3 random_normal(falling_particles::Random& random);

/// A uniform rotation.
supernormal::Matrix3 random_orientation(falling_particles::Random& random);

}  // namespace accuracy_cost
