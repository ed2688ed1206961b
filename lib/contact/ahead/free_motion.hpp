// The motion of bodies within a step without contact forces, and the contacts at its end.
#pragma once

#include <functional>

#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/impact/motion.hpp"

namespace supernormal {

/// The motions of two bodies within a step without contact forces. A step of ODE moves a body with the velocity that it has after
/// the step.
class FreeMotion {
 public:
  FreeMotion(const BodyAhead& body1, const BodyAhead& body2, double time);

  const Motion& motion1() const { return motion1_; }
  const Motion& motion2() const { return motion2_; }
  Pose end1() const { return pose_at(motion1_, time_); }
  Pose end2() const { return pose_at(motion2_, time_); }

  /// Whether the paths are not those of the velocities.
  bool bends() const { return bends_; }

  /// The most that a contact takes away of the approach, m.
  double held_back_by(const ContactManifold& contacts) const;

  /// Takes away from the velocity of body 1 what a contact takes away.
  void stop_at(const ContactManifold& contacts);

  /// Moves contacts at the end of the motion back to the present poses, with gaps of which the motion leaves what it leaves. A
  /// plane at the end may be an overlap now. Their lever arms stay: so a ball that rolls bears its weight under its centre. `share`
  /// is the share of body 1 in the mobilities.
  void take_back(double share, ContactManifold& contacts) const;

 private:
  Motion of(const BodyAhead& body) const;

  /// How much the bodies approach at `place`, linear in the motion as a row of contact forces is, m.
  double closed_at(const Vector3& place, const Vector3& normal) const;

  double time_;  // s
  Vector3 centre1_, centre2_;
  Motion motion1_, motion2_;
  bool bends_;
};

/// The body as it moves without forces.
BodyAhead without_forces(BodyAhead body);

/// Takes overlaps as touch. Bodies that are apart do not overlap, although the tangent planes at the end may say so.
void remove_overlaps(ContactManifold& contacts);

/// The contacts of `find(motion)` for the free motion. A floor may bear the body. Then its motion is `borne`, without its weight,
/// and a contact below the floor has the wrong normal. If this would take more than `graze` (m) away from `borne`, the contacts
/// are those for `borne`, unless these take more than `negligible` (m) away from the free motion. `manifold` is the member of a
/// contact.
template <class Find, class Projection = std::identity>
auto choose_contacts(const FreeMotion& free, const FreeMotion& borne, double graze, double negligible, const Find& find,
                     Projection manifold = {}) {
  auto contacts = find(free);
  if (!contacts) return contacts;
  if (borne.held_back_by(std::invoke(manifold, *contacts)) > graze) {
    const auto beside = find(borne);
    if (beside && !(free.held_back_by(std::invoke(manifold, *beside)) > negligible)) contacts = beside;
  }
  remove_overlaps(std::invoke(manifold, *contacts));
  return contacts;
}

}  // namespace supernormal
