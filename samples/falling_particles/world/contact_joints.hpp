// The contact joints of a step.
#pragma once

#include <ode/ode.h>

#include <deque>
#include <span>

#include "world.hpp"

namespace falling_particles {

/// The most contacts that a pair may ask for: a face on a face is held by four points and the deepest one.
inline constexpr int kContactsPerPair = 5;

/// A contact whose joint says with which force it holds the bodies apart.
struct MeasuredContact {
  dContactGeom geom;
  dJointFeedback feedback;
  bool is_reversed = false;  ///< whether the joint's first body is that of geom.g2

  /// N, in the world's frame, on the body of geom.g1; after the step.
  Point force() const;
};

/// The contacts of a step as joints of a world, which must outlive them.
class ContactJoints {
 public:
  explicit ContactJoints(const World& world);
  ~ContactJoints();
  ContactJoints(const ContactJoints&) = delete;
  ContactJoints(ContactJoints&&) = delete;
  ContactJoints& operator=(const ContactJoints&) = delete;
  ContactJoints& operator=(ContactJoints&&) = delete;

  /// Replaces the joints of the last step by those for `contacts`, as the effects of the world set them up. The contacts of a
  /// pair, at most kContactsPerPair, are consecutive. If `measures`, the next step tells measured() their forces.
  void replace(std::span<const dContactGeom> contacts, bool measures = false);

  /// The contacts that the effects have left, in the order of their pairs; none when the last ones were not to be measured.
  const std::deque<MeasuredContact>& measured() const { return measured_; }

 private:
  using Side = supernormal::effects::Side;

  void attach(std::span<const dContactGeom> pair, bool measures);
  Side side_of(dGeomID geom) const;
  void follow_chords(std::span<dContact> contacts, const Side& side1, const Side& side2) const;
  void measure(dJointID joint, const dContact& contact, bool is_reversed);

  const World& world_;
  dJointGroupID joints_;
  std::deque<MeasuredContact> measured_;  // the joints hold pointers to its elements, which stay where they are
};

}  // namespace falling_particles
