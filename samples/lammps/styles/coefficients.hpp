// The contact parameters in pair_coeff and in the commands of walls.
#pragma once

#include "kernel/contact_material.hpp"
#include "styles/words.hpp"

namespace granular {

/// The parsed parameters.
struct Coefficients {
  bool has_material = false;
  ContactMaterial material;
  bool has_exponents = false;
  double delta = 2, epsilon = 2;
};

/// Parses, in any order,
///     hooke STIFFNESS | hertz YOUNGS_MODULUS POISSON_RATIO, restitution E, friction MU, tangential RATIO, rolling LENGTH,
///     spinning LENGTH, adhesion FORCE, exponents DELTA EPSILON
/// All have defaults except the law. Throws std::invalid_argument with the error.
Coefficients read_coefficients(Words words);

}  // namespace granular
