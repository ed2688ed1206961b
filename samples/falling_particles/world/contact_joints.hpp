// The contact joints of a step.
#pragma once

#include <ode/ode.h>

#include <deque>
#include <span>

#include "world.hpp"

namespace falling_particles {

/// max_contacts of a pair: four points support a face on a face, and the deepest point is the fifth.
inline constexpr int kContactsPerPair = 5;

/// A contact with its force.
struct MeasuredContact {
  dContactGeom geom;
  dJointFeedback feedback;   ///< by the stepper, only f1
  bool is_reversed = false;  ///< whether the joint's first body is the body of geom.g2

  /// N, in the world's frame, on the body of geom.g1; valid after the step.
  Point force() const;
};

/// The contact joints of a step in a world, which must outlive them; or the contacts that its stepper takes in their place.
class ContactJoints {
 public:
  explicit ContactJoints(const World& world);
  ~ContactJoints();
  ContactJoints(const ContactJoints&) = delete;
  ContactJoints(ContactJoints&&) = delete;
  ContactJoints& operator=(const ContactJoints&) = delete;
  ContactJoints& operator=(ContactJoints&&) = delete;

  /// Replaces the joints of the last step by joints for `contacts`, as the effects of the world set them up. The contacts of a
  /// pair, at most kContactsPerPair, must be consecutive. Of two walls the first is free; it has the friction and restitution of
  /// grains on the second. If `measures`, measured() has their forces after the next step.
  void replace(std::span<const dContactGeom> contacts, bool measures = false);
  /// Adds further contacts, of the rest of a step that ended early.
  void add(std::span<const dContactGeom> contacts, bool measures = false);
  /// After the stepper has made the fraction `part` of a step: the measured forces are means over the step. The contacts must be
  /// the first ones that the stepper was given.
  void read_forces(double part);

  /// The contacts that the effects have kept, in the order of their pairs; of a step that ended early, part by part. Empty if
  /// `measures` was false.
  const std::deque<MeasuredContact>& measured() const { return measured_; }

 private:
  using Side = supernormal::effects::Side;

  void attach(std::span<const dContactGeom> pair, bool measures);
  Side side_of(dGeomID geom) const;
  void follow_chords(std::span<dContact> contacts, const Side& side1, const Side& side2) const;
  void measure(dJointID joint, const dContact& contact, bool is_reversed);

  const World& world_;
  dJointGroupID joints_;
  std::deque<MeasuredContact> measured_;  // the joints point to its elements, which a deque does not move
  std::size_t read_ = 0;                  // how many of them have their force, by the stepper
};

}  // namespace falling_particles
