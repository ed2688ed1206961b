// The material of two surfaces in contact.
#pragma once

#include <string>

namespace granular {

/// The elastic normal force.
enum class NormalLaw {
  Hooke,  ///< stiffness times depth
  Hertz,  ///< two elastic bodies with their curvatures at the contact
};

/// The parameters of a contact of two surfaces. The restitution determines the damping of all three springs.
struct ContactMaterial {
  NormalLaw law = NormalLaw::Hooke;
  double stiffness = 0;              ///< Hooke: N/m. Hertz: effective modulus E/(2 (1 - nu^2)) of two equal materials, Pa. > 0
  double restitution = 1;            ///< of a frictionless impact along the line of centres, in [0.05, 1]
  double friction = 0;               ///< Coulomb coefficient, >= 0; 0: no tangential spring
  double tangential_ratio = 2 / 7.;  ///< tangential over normal stiffness, in (0, 1]
  double rolling_length = 0;         ///< m; largest rolling torque over the normal force, >= 0; 0: no rolling resistance
  double spinning_length = 0;  ///< m; largest torque about the normal over the normal force, >= 0; 0: no resistance to spinning
  double adhesion = 0;         ///< N; pull-off force, >= 0

  double damping_ratio = 0;  ///< computed by prepared()
};

/// Validates the parameters and sets damping_ratio. Throws std::invalid_argument with the parameter, its value and the valid range.
ContactMaterial prepared(ContactMaterial material);

/// The contact of two materials. Normal and tangential springs are in series; for Hertz's law this is the exact modulus E* and
/// Mindlin's tangential stiffness of two materials. Other parameters have their geometric mean. Throws std::invalid_argument if the
/// laws differ.
ContactMaterial mixed(const ContactMaterial& a, const ContactMaterial& b);

/// The effective modulus (Pa) of two equal bodies with Young's modulus (Pa) and Poisson's ratio, and Mindlin's ratio of tangential
/// to normal stiffness.
double effective_modulus(double youngs_modulus, double poisson_ratio);
double mindlin_ratio(double poisson_ratio);

/// The damping ratio b, in 2 b sqrt(k m), of a linear spring that gives an impact this restitution, in (0, 1]. The contact ends as
/// soon as its force would become attractive (Schwager and Poeschel, Granular Matter 9, 465 (2007)). The ratio does not depend on
/// the velocity.
double hooke_damping_ratio(double restitution);

/// Throws std::invalid_argument with the parameter, its value and the valid range.
[[noreturn]] void refuse(const std::string& name, double value, const std::string& range);

}  // namespace granular
