// The contact force between two overlapping bodies.
#pragma once

#include "kernel/body.hpp"
#include "kernel/contact_history.hpp"
#include "kernel/contact_material.hpp"
#include "kernel/normal_force.hpp"

namespace granular {

/// The contact of two bodies, in the world frame.
struct Contact {
  Vector3 normal;  ///< unit, from body 1 to body 2
  Vector3 arm1;    ///< m; from the centre of body 1 to the contact point
  Vector3 arm2;    ///< m; from the centre of body 2 to the contact point
  double depth;    ///< m; >= 0
};

/// The result of the contact law.
struct ContactForce {
  Vector3 force = Vector3::Zero();           ///< N; on body 1, at the contact point; the opposite acts on body 2
  Vector3 rolling_torque = Vector3::Zero();  ///< N m; on body 1, in addition to the force's; the opposite acts on body 2
  double normal = 0;                         ///< N; >= 0
  double energy = 0;                         ///< J; in the springs
  bool slips = false;                        ///< whether friction is at its limit
};

/// The contact force for the elastic normal force `elastic`:
/// - a damped normal force, which never pulls;
/// - Coulomb friction with a tangential spring, which rotates with the contact;
/// - a rolling spring.
/// `history` holds the springs and the normal at `step` (s) earlier, and is advanced. With a step of 0 it is only read.
ContactForce contact_force(const Contact& contact, const NormalForce& elastic, const ContactMaterial& material, const Body& body1,
                           const Body& body2, double step, ContactHistory& history);

}  // namespace granular
