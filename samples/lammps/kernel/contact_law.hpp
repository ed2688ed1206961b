// The force between two bodies that overlap.
#pragma once

#include "kernel/body.hpp"
#include "kernel/contact_history.hpp"
#include "kernel/contact_material.hpp"
#include "kernel/normal_force.hpp"

namespace granular {

/// Where two bodies overlap, in the world's frame.
struct Contact {
  Vector3 normal;  ///< unit, from body 1 to body 2
  Vector3 arm1;    ///< m; from the centre of body 1 to the point where the force acts
  Vector3 arm2;    ///< m; from the centre of body 2 to it
  double depth;    ///< m; >= 0
};

/// What a contact does.
struct ContactForce {
  Vector3 force = Vector3::Zero();           ///< N; on body 1, at the contact's point; the opposite acts on body 2
  Vector3 rolling_torque = Vector3::Zero();  ///< N m; on body 1, beside that of the force; the opposite acts on body 2
  double normal = 0;                         ///< N; >= 0
  double energy = 0;                         ///< J; in the springs
  bool slips = false;                        ///< friction is at its limit
};

/// The force of a contact whose elastic part is `elastic`: the damped normal force, which never pulls; Coulomb friction with a
/// tangential spring, which turns with the contact; and a rolling spring. `history` holds the springs as they were `step` (s) ago
/// and the normal of that time; they are advanced. With a step of 0 they are only read, and are left as they were.
ContactForce contact_force(const Contact& contact, const NormalForce& elastic, const ContactMaterial& material, const Body& body1,
                           const Body& body2, double step, ContactHistory& history);

}  // namespace granular
