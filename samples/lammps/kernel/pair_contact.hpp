// Two bodies: where they are in contact, and what they do to each other.
#pragma once

#include "kernel/contact_law.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace granular {

/// How a query of a pair ended.
enum class PairState {
  Apart,
  Touching,
  Failed,  ///< a pose is not finite
};

/// The answer for a pair.
struct PairContact {
  PairState state = PairState::Apart;
  Contact contact;      ///< where they touch; undefined when they do not
  ContactForce force;   ///< on body 1
  int evaluations = 0;  ///< of the gap function

  /// N m; about the centre of body 1, and of body 2.
  Vector3 torque1() const { return contact.arm1.cross(force.force) + force.rolling_torque; }
  Vector3 torque2() const { return -contact.arm2.cross(force.force) - force.rolling_torque; }
};

/// The contact of two bodies. `settings` should end at the first proof that they are apart (stop_when_apart). `history` gives the
/// query its first normal and is advanced by `step` (s); with a step of 0 it is only read. It neither allocates nor throws, and any
/// number of threads may call it for different pairs.
PairContact find_pair_contact(const Body& body1, const Body& body2, const ContactMaterial& material,
                              const supernormal::Settings& settings, double step, ContactHistory& history);

}  // namespace granular
