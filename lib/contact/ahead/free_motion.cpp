#include "contact/ahead/free_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact/ahead/nearness.hpp"
#include "supernormal/impact/motion.hpp"
#include "supernormal/impact/time_of_impact.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal {
namespace {

/// The motions of two bodies without contact forces. A step of ODE moves a body with the velocity that it has after the step.
class FreeMotion {
 public:
  FreeMotion(const BodyAhead& body1, const BodyAhead& body2, double time)
      : time_(time), start1_(body1.pose.position), start2_(body2.pose.position), motion1_(of(body1)), motion2_(of(body2)) {}

  const Motion& motion1() const { return motion1_; }
  const Motion& motion2() const { return motion2_; }
  Pose end1() const { return pose_at(motion1_, time_); }
  Pose end2() const { return pose_at(motion2_, time_); }

  /// How much the bodies approach at `place`, linear in the motion as a row of contact forces is, m.
  double closed_at(const Vector3& place, const Vector3& normal) const {
    const Vector3 displacement1 = motion1_.velocity + motion1_.angular_velocity.cross(place - centre1());
    const Vector3 displacement2 = motion2_.velocity + motion2_.angular_velocity.cross(place - centre2());
    return time_ * normal.dot(displacement1 - displacement2);
  }

  /// Whether a contact takes more than `negligible` (m) away.
  bool is_restricted_by(const ContactManifold& contacts, double negligible) const {
    const Vector3& normal = contacts.deepest.normal;
    const auto restricts = [&](const Vector3& place, double gap) { return closed_at(place, normal) - gap > negligible; };
    if (contacts.corner_count == 0) return restricts(contacts.deepest.contact, contacts.deepest.gap);
    const auto end = contacts.corners.begin() + contacts.corner_count;
    return std::any_of(contacts.corners.begin(), end, [&](const ManifoldCorner& it) { return restricts(it.point, -it.depth); });
  }

  /// Moves contacts at the end of the motion back to the present poses. Their lever arms stay: so a ball that rolls bears its
  /// weight under its centre.
  void take_back(double share, ContactManifold& contacts) const {
    const Vector3 displacement = time_ * (share * motion1_.velocity + (1 - share) * motion2_.velocity);
    Proximity& deepest = contacts.deepest;
    const auto gap_now = [&](const Vector3& place, double gap) { return std::max(0.0, gap + closed_at(place, deepest.normal)); };
    deepest.point1 -= time_ * motion1_.velocity;
    deepest.point2 -= time_ * motion2_.velocity;
    deepest.contact -= displacement;
    deepest.gap = gap_now(deepest.contact, deepest.gap);
    for (ManifoldCorner& corner : contacts.corners) {
      corner.point -= displacement;
      corner.depth = -gap_now(corner.point, -corner.depth);
    }
  }

 private:
  Motion of(const BodyAhead& body) const {
    const MotionAhead& motion = body.motion;
    const Vector3 to_centre = motion.centre - body.pose.position;
    return {body.pose, motion.velocity + time_ * motion.acceleration + motion.angular_velocity.cross(to_centre),
            motion.angular_velocity, body.pose.rotation.transpose() * to_centre};
  }

  Vector3 centre1() const { return start1_ + motion1_.pose.rotation * motion1_.centre; }
  Vector3 centre2() const { return start2_ + motion2_.pose.rotation * motion2_.centre; }

  double time_;  // s
  Vector3 start1_, start2_;
  Motion motion1_, motion2_;
};

/// Whether the free motion differs from a motion along the velocities.
bool bends(const MotionAhead& motion1, const MotionAhead& motion2) {
  return motion1.acceleration != motion2.acceleration || !motion1.angular_velocity.isZero(0) || !motion2.angular_velocity.isZero(0);
}

}  // namespace

std::optional<ContactManifold> find_contacts_after_free_motion(const BodyAhead& body1, const BodyAhead& body2, double time,
                                                               double share, const Settings& settings, const Proximity& now,
                                                               const ContactManifold& ahead) {
  if (!(now.gap > 0) || !bends(body1.motion, body2.motion)) return std::nullopt;
  const FreeMotion free(body1, body2, time);
  if (!free.is_restricted_by(ahead, now.error)) return std::nullopt;
  const Pose end1 = free.end1(), end2 = free.end2();
  const Vector3 normal = end1.rotation.transpose() * ahead.deepest.normal;
  const Proximity there = find_proximity(body1.shape, end1, body2.shape, end2, settings, &normal);
  if (there.status == Status::InvalidInput || !(there.gap > 0)) return std::nullopt;
  const Vector3 first = body1.pose.rotation.transpose() * now.normal;
  const Impact impact = find_time_of_impact(body1.shape, free.motion1(), body2.shape, free.motion2(), time, settings, &first);
  if (impact.may_hit()) return std::nullopt;
  ContactManifold contacts = find_manifold_of_gaps(body1.shape, end1, body2.shape, end2, there, share);
  free.take_back(share, contacts);
  contacts.deepest.evaluations = ahead.deepest.evaluations + there.evaluations + impact.evaluations;
  contacts.reach = ahead.reach;
  return contacts;
}

std::optional<ContactManifold> find_plane_contacts_after_free_motion(const BodyAhead& body, double time, const Proximity& now,
                                                                     const ContactManifold& ahead) {
  if (!(now.gap > 0) || body.motion.angular_velocity.isZero(0)) return std::nullopt;
  const FreeMotion free(body, {body.shape, body.pose, {}}, time);
  if (!free.is_restricted_by(ahead, now.error)) return std::nullopt;
  const Vector3 upwards = -now.normal;
  const double offset = upwards.dot(now.point2);
  const Pose end = free.end1();
  const Proximity there = find_plane_proximity(body.shape, end, upwards, offset);
  if (there.status == Status::InvalidInput || !(there.gap > 0)) return std::nullopt;
  if (find_plane_time_of_impact(body.shape, free.motion1(), upwards, offset, time).may_hit()) return std::nullopt;
  ContactManifold contacts = find_plane_manifold_of_gaps(body.shape, end, there);
  free.take_back(1, contacts);
  contacts.reach = ahead.reach;
  return contacts;
}

}  // namespace supernormal
