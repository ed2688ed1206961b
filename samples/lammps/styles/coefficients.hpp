// The words of pair_coeff and of the walls that say what a contact is like.
#pragma once

#include "kernel/contact_material.hpp"
#include "styles/words.hpp"

namespace granular {

/// What the words set.
struct Coefficients {
  bool has_material = false;
  ContactMaterial material;
  bool has_exponents = false;
  double delta = 2, epsilon = 2;
};

/// Reads
///     hooke STIFFNESS | hertz YOUNGS_MODULUS POISSON_RATIO, restitution E, friction MU, tangential RATIO, rolling LENGTH,
///     exponents DELTA EPSILON
/// in any order; all but the law have defaults. std::invalid_argument says what is wrong.
Coefficients read_coefficients(Words words);

}  // namespace granular
