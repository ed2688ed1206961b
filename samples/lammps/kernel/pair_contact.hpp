// The contact of two bodies and its forces.
#pragma once

#include "kernel/contact_law.hpp"
#include "supernormal/contact/contact_curvature.hpp"

namespace granular {

/// How a query of a pair ended.
enum class PairState {
  Apart,
  Touching,
  Failed,  ///< a pose is not finite
};

/// The result for a pair.
struct PairContact {
  PairState state = PairState::Apart;
  Contact contact;            ///< undefined unless they touch
  ContactForce force;         ///< on body 1
  double share_of_faces = 0;  ///< in [0, 1]: FaceContact::share
  int corners = 0;            ///< the corners of faces that share the force
  int evaluations = 0;        ///< evaluations of the gap function

  /// Torque about the centre of body 1, and of body 2, N m.
  Vector3 torque1() const { return contact.arm1.cross(force.force) + force.torque; }
  Vector3 torque2() const { return -contact.arm2.cross(force.force) - force.torque; }
};

/// A query of a pair, from its history. It refers to the bodies and to itself.
struct PairQuery {
  Vector3 first_normal;  ///< in the frame of body 1
  supernormal::ProximityQuery query;

  PairQuery() = default;
  PairQuery(const PairQuery&) = delete;
  PairQuery& operator=(const PairQuery&) = delete;

  void set(const Body& body1, const Body& body2, const ContactHistory& history) {
    first_normal = body1.pose.rotation.transpose() * history.normal;
    query = {body1.shape, &body1.pose, body2.shape, &body2.pose, history.has_normal() ? &first_normal : nullptr};
  }
};

/// The contact from the answer to a query, with the curvature that find_proximities() gives. `history` is advanced by `step` (s).
/// With a step of 0 it is only read. The function neither allocates nor throws.
PairContact contact_of(const supernormal::Proximity& found, const supernormal::ContactCurvature& curvature, const Body& body1,
                       const Body& body2, const ContactMaterial& material, double step, ContactHistory& history);

/// The contact of two bodies. Set stop_when_apart in `settings`, so that a query ends at the first proof of separation. `history`
/// gives the query its first normal and is advanced by `step` (s). With a step of 0 it is only read. The function neither allocates
/// nor throws. Threads may call it in parallel for different pairs.
PairContact find_pair_contact(const Body& body1, const Body& body2, const ContactMaterial& material,
                              const supernormal::Settings& settings, double step, ContactHistory& history);

}  // namespace granular
