// Random normals and orientations.
#pragma once

#include "common/random.hpp"
#include "supernormal/shapes/shape.hpp"

namespace accuracy_cost {

double uniform(common::Random& random, double low, double high);

/// A unit vector, uniform on the sphere.
supernormal::Vector3 random_normal(common::Random& random);

/// A uniform rotation.
supernormal::Matrix3 random_orientation(common::Random& random);

}  // namespace accuracy_cost
