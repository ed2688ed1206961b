// The elastic normal force of a contact.
#pragma once

#include "kernel/contact_material.hpp"
#include "supernormal/contact/contact_curvature.hpp"

namespace granular {

/// The state of a spring at some depth.
struct NormalForce {
  double force = 0;      ///< N
  double stiffness = 0;  ///< N/m; derivative of the force by the depth
  double energy = 0;     ///< J; integral of the force over the depth
};

/// Hooke's law.
NormalForce hooke_force(const ContactMaterial& material, double depth);

/// Hertz's law for a depth (m, > 0) and a relative curvature. The radius of flat faces is infinite. The force therefore grows no
/// faster than under a flat punch of half the `width` (m), the mean half-extent of the smaller body.
NormalForce hertz_force(const ContactMaterial& material, double depth, const supernormal::ContactCurvature& curvature,
                        double width);

}  // namespace granular
