// Random normals and attitudes.
#pragma once

#include "simulation/random.hpp"
#include "supernormal/shapes/shape.hpp"

namespace accuracy_cost {

double uniform(falling_particles::Random& random, double low, double high);

/// Unit vectors, uniform over the sphere.
supernormal::Vector3 random_normal(falling_particles::Random& random);

/// Rotations, uniform.
supernormal::Matrix3 random_attitude(falling_particles::Random& random);

}  // namespace accuracy_cost
