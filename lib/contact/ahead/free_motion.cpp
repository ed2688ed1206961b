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

FreeMotion::FreeMotion(const BodyAhead& body1, const BodyAhead& body2, double time)
    : time_(time), centre1_(body1.motion.centre), centre2_(body2.motion.centre), motion1_(of(body1)), motion2_(of(body2)) {
  const bool rotates = !body1.motion.angular_velocity.isZero(0) || !body2.motion.angular_velocity.isZero(0);
  bends_ = rotates || body1.motion.acceleration != body2.motion.acceleration;
}

Motion FreeMotion::of(const BodyAhead& body) const {
  const MotionAhead& motion = body.motion;
  const Vector3 to_centre = motion.centre - body.pose.position;
  return {body.pose, motion.velocity + time_ * motion.acceleration + motion.angular_velocity.cross(to_centre),
          motion.angular_velocity, body.pose.rotation.transpose() * to_centre};
}

double FreeMotion::closed_at(const Vector3& place, const Vector3& normal) const {
  const Vector3 velocity1 = motion1_.velocity + motion1_.angular_velocity.cross(place - centre1_);
  const Vector3 velocity2 = motion2_.velocity + motion2_.angular_velocity.cross(place - centre2_);
  return time_ * normal.dot(velocity1 - velocity2);
}

bool FreeMotion::is_held_back_by(const ContactManifold& contacts, double negligible) const {
  if (!bends_) return false;
  const Vector3& normal = contacts.deepest.normal;
  const auto holds = [&](const Vector3& place, double gap) { return closed_at(place, normal) - gap > negligible; };
  if (contacts.corner_count == 0) return holds(contacts.deepest.contact, contacts.deepest.gap);
  const auto end = contacts.corners.begin() + contacts.corner_count;
  return std::any_of(contacts.corners.begin(), end, [&](const ManifoldCorner& it) { return holds(it.point, -it.depth); });
}

void FreeMotion::take_back(double share, ContactManifold& contacts) const {
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

std::optional<ContactManifold> find_contacts_after_free_motion(const BodyAhead& body1, const BodyAhead& body2, double time,
                                                               double share, const Settings& settings, const Proximity& now,
                                                               const ContactManifold& ahead) {
  if (!(now.gap > 0)) return std::nullopt;
  const FreeMotion free(body1, body2, time);
  if (!free.is_held_back_by(ahead, now.error)) return std::nullopt;
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
  if (!free.is_held_back_by(ahead, now.error)) return std::nullopt;
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
