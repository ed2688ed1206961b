// The elastic force of a contact.
#pragma once

#include "kernel/contact_material.hpp"
#include "supernormal/contact/contact_curvature.hpp"

namespace granular {

/// A spring at a depth.
struct NormalForce {
  double force = 0;      ///< N
  double stiffness = 0;  ///< N/m; change of the force with the depth
  double energy = 0;     ///< J; its integral over the depth
};

/// Hooke's law.
NormalForce hooke_force(const ContactMaterial& material, double depth);

/// Hertz's law for a depth (m, > 0) and a relative curvature. Flat faces have an infinite radius; the force grows no faster than
/// that of a flat punch of half the `width` (m): the mean half-extent of the smaller body.
NormalForce hertz_force(const ContactMaterial& material, double depth, const supernormal::ContactCurvature& curvature,
                        double width);

}  // namespace granular
