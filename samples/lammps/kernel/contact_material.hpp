// What two touching surfaces are made of.
#pragma once

namespace granular {

/// The elastic force of a contact.
enum class NormalLaw {
  Hooke,  ///< stiffness times depth
  Hertz,  ///< two elastic bodies with the curvatures that they have at the contact
};

/// The parameters of a contact of two surfaces. The damping of all three springs follows from the restitution.
struct ContactMaterial {
  NormalLaw law = NormalLaw::Hooke;
  double stiffness = 0;              ///< Hooke: N/m. Hertz: the effective modulus E/(2 (1 - nu^2)) of two equal materials, Pa. > 0
  double restitution = 1;            ///< of a frictionless impact along the line of centres, in [0.05, 1]
  double friction = 0;               ///< Coulomb's coefficient, >= 0; 0: there is no tangential spring
  double tangential_ratio = 2 / 7.;  ///< stiffness of the tangential spring over that of the normal one, in (0, 1]
  double rolling_length = 0;         ///< m; largest rolling torque over the normal force, >= 0; 0: there is no rolling resistance

  double damping_ratio = 0;  ///< follows from the others: see prepared()
};

/// Checks the parameters and sets damping_ratio. std::invalid_argument names the parameter, its value and the valid range.
ContactMaterial prepared(ContactMaterial material);

/// The effective modulus, Pa, of two bodies with Young's modulus (Pa) and Poisson's ratio, and Mindlin's ratio of tangential and
/// normal stiffness.
double effective_modulus(double youngs_modulus, double poisson_ratio);
double mindlin_ratio(double poisson_ratio);

}  // namespace granular
