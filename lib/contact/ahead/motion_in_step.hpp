// The motion of two bodies within a step: how near they may come, where they meet, and where they go without contact forces.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/impact/motion.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

// A push within the same step may close a gap up to this fraction of the smaller half-extent.
inline constexpr double kSlack = 0.01;

/// The farthest that rotation moves a point of the body within `time`, m: at most to the other side.
inline double shift_by_rotation(const MotionAhead& motion, double time) {
  return motion.arm * std::min(2.0, motion.angular_velocity.norm() * time);
}

/// How much faster two bodies may approach after `time`, m/s. One of two falling bodies may be held by others.
inline double gained_speed(const MotionAhead& motion1, const MotionAhead& motion2, double time) {
  return time * std::max(motion1.acceleration.norm(), motion2.acceleration.norm());
}

/// How much more than by their velocities two bodies may approach within `time`, m.
inline double nearness_of_both(const MotionAhead& motion1, const MotionAhead& motion2, double time, double size) {
  return shift_by_rotation(motion1, time) + shift_by_rotation(motion2, time) + gained_speed(motion1, motion2, time) * time +
         kSlack * size;
}

/// How far two bodies would overlap after `time` at their velocities, along the unit normal from body 1 to body 2, m. Negative:
/// they stay apart. The weight of a body that rests does not count: it turns nothing over.
inline double approach_of(const MotionAhead& motion1, const MotionAhead& motion2, double time, const Vector3& normal, double gap) {
  return normal.dot(motion1.velocity - motion2.velocity) * time - gap;
}

/// How much farther along `direction` (unit) a body extends after it has turned for `time`, m. `point`: where it extends farthest
/// now.
inline double growth_by_rotation(const BodyAhead& body, const Vector3& direction, const Vector3& point, double time) {
  const Vector3 turn = time * body.motion.angular_velocity.cross(direction);
  if (turn.isZero(0)) return 0;
  const double extent = body.shape.support(body.pose.rotation.transpose() * (direction - turn).normalized());
  return std::clamp(extent - direction.dot(point - body.pose.position), 0.0, turn.norm() * body.motion.arm);
}

inline bool is_finite(const MotionAhead& motion) {
  return motion.velocity.allFinite() && motion.centre.allFinite() && motion.turning.allFinite() &&
         motion.angular_velocity.allFinite() && motion.acceleration.allFinite() && motion.angular_acceleration.allFinite() &&
         std::isfinite(motion.arm) && std::isfinite(motion.mobility);
}

/// The share of body 1 in the sum of the mobilities.
inline double share_of_first(const MotionAhead& motion1, const MotionAhead& motion2) {
  const double sum = motion1.mobility + motion2.mobility;
  return sum > 0 ? motion1.mobility / sum : 0.5;
}

// An overlap below this fraction of the size during the motion is no impact.
inline constexpr double kGraze = 0.01;

struct Meeting {
  double time = 0;      ///< s from now; 0: use the present poses
  Proximity there;      ///< of the bodies at that time, without rotation
  bool hits = false;    ///< whether they meet within the time step
  int evaluations = 0;  ///< evaluations of the gap function
};

/// The smallest half-extent of the two bodies, m. Bodies without thickness are ignored.
double smaller_thickness(const Shape& shape1, const Shape& shape2);

/// The body after `time` at its velocity, without rotation.
BodyAhead moved(const BodyAhead& body, double time);

/// Moves a manifold back by the displacements of the bodies, m, and each contact by their mean with the weight `share` of body 1.
/// Bodies that are apart by `gap` (m) do not overlap. The tangent planes there may say otherwise.
void take_back(ContactManifold& manifold, const Vector3& displacement1, const Vector3& displacement2, double share, double gap);

/// Finds the first time at which the bodies overlap by kGraze * `size` (m). If there is none within `time`, the result is the state
/// at `time`. Smaller overlaps are ignored, so a body that slides over two flush bodies does not hit the edge of the second.
///
/// No impact is missed. Without rotation the gap is convex in time: it is a maximum of linear functions, one for each normal. A
/// convex function lies above its tangents, so Newton's steps do not pass the first time at which it has a given value.
///
/// Returns `now` if the displacement is negligible, or if a pose leaves the valid range.
Meeting find_meeting(const BodyAhead& body1, const BodyAhead& body2, double time, double size, const Settings& settings,
                     const Proximity& now);

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
  Vector3 turning_of(const MotionAhead& motion) const;
  Motion of(const BodyAhead& body) const;

  /// How much the bodies approach at `place`, linear in the motion as a row of contact forces is, m.
  double closed_at(const Vector3& place, const Vector3& normal) const;

  double time_;  // s
  Vector3 centre1_, centre2_;
  Motion motion1_, motion2_;
  Vector3 turning1_, turning2_;  // rad/s
  bool bends_;
};

/// The body as it moves without forces.
BodyAhead without_forces(BodyAhead body);

/// Takes deeper overlaps as `greatest_depth` (m). Bodies that are apart do not overlap, although the tangent planes at the end may
/// say so.
void limit_overlaps(ContactManifold& contacts, double greatest_depth);

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
  limit_overlaps(std::invoke(manifold, *contacts), 0);
  return contacts;
}

}  // namespace supernormal
