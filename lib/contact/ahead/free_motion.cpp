#include "contact/ahead/free_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact/ahead/meeting.hpp"
#include "contact/ahead/nearness.hpp"
#include "contact/ahead/small_rotation.hpp"
#include "contact/manifold/common_corners.hpp"
#include "supernormal/impact/motion.hpp"
#include "supernormal/impact/time_of_impact.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal {
namespace {

// Two contacts with normals that differ by less than this have one normal.
constexpr double kParallel = 1e-6;

/// Upper bound of what another point of the bodies approaches more than a contact, by rotation, m.
double most_swing(const MotionAhead& motion1, const MotionAhead& motion2, double time) {
  return 2 * (shift_by_rotation(motion1, time) + shift_by_rotation(motion2, time));
}

/// Two single contacts of a round body with the same normal, now and at the end of the free motion, as one manifold.
void add_end(const BodyAhead& body1, const BodyAhead& body2, double time, double share, const ContactManifold& ahead,
             ContactManifold& contacts) {
  limit_rotation(body1, body2, time, share, contacts);
  const ManifoldCorner end{contacts.deepest.contact, -contacts.deepest.gap};
  const ManifoldCorner now{ahead.deepest.contact, -ahead.deepest.gap};
  if (now.depth > end.depth) contacts.deepest = ahead.deepest;
  contacts.corners = {now, now, end, end};
  contacts.corner_count = ContactManifold::kMaxCorners;
  contacts.same_place = kSamePlace * smaller_thickness(body1.shape, body2.shape);
  contacts.shallow = kShallow * contacts.same_place;
}

}  // namespace

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

double FreeMotion::held_back_by(const ContactManifold& contacts) const {
  if (!bends_) return 0;
  const Proximity& deepest = contacts.deepest;
  if (contacts.corner_count == 0) return std::max(0.0, closed_at(deepest.contact, deepest.normal) - deepest.gap);
  double most = 0;
  for (const ManifoldCorner& corner : contacts.corners)
    most = std::max(most, closed_at(corner.point, deepest.normal) + corner.depth);
  return most;
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
  const FreeMotion free(body1, body2, time);
  const double held_back = free.held_back_by(ahead);
  const double graze = kGraze * smaller_thickness(body1.shape, body2.shape);
  const bool may_be_free = now.gap > 0 && held_back > now.error;
  const bool may_swing_in = ahead.corner_count == 0 && most_swing(body1.motion, body2.motion, time) > graze;
  if (!may_be_free && !may_swing_in) return std::nullopt;
  const Pose end1 = free.end1(), end2 = free.end2();
  const Vector3 normal = end1.rotation.transpose() * ahead.deepest.normal;
  int evaluations = ahead.deepest.evaluations;
  if (!may_be_free) {
    ++evaluations;
    GapJet planes;  // the tangent planes with the normal of the contact prove that the end is no deeper than they say
    GapFunction(body1.shape, end1, body2.shape, end2).evaluate(normal, Order::Point, planes);
    if (!(-planes.s > held_back + graze)) return std::nullopt;
  }
  const Proximity there = find_proximity(body1.shape, end1, body2.shape, end2, settings, &normal);
  if (there.status == Status::InvalidInput) return std::nullopt;
  const bool has_same_normal = (there.normal - ahead.deepest.normal).norm() < kParallel;
  const bool swings_in = may_swing_in && -there.gap > held_back + graze && has_same_normal;
  if (!swings_in && !(may_be_free && there.gap > 0)) return std::nullopt;
  ContactManifold contacts = find_manifold_of_gaps(body1.shape, end1, body2.shape, end2, there, share);
  contacts.deepest.evaluations = evaluations + there.evaluations;
  if (!swings_in) {
    const Vector3 first = body1.pose.rotation.transpose() * now.normal;
    const Impact impact = find_time_of_impact(body1.shape, free.motion1(), body2.shape, free.motion2(), time, settings, &first);
    if (impact.may_hit()) return std::nullopt;
    contacts.deepest.evaluations += impact.evaluations;
  }
  free.take_back(share, contacts);
  contacts.reach = ahead.reach;
  if (swings_in) add_end(body1, body2, time, share, ahead, contacts);
  return contacts;
}

std::optional<ContactManifold> find_plane_contacts_after_free_motion(const BodyAhead& body, double time, const Proximity& now,
                                                                     const ContactManifold& ahead) {
  if (body.motion.angular_velocity.isZero(0)) return std::nullopt;
  const BodyAhead plane{body.shape, body.pose, {}};
  const FreeMotion free(body, plane, time);
  const double held_back = free.held_back_by(ahead);
  const Vector3 upwards = -now.normal;
  const double offset = upwards.dot(now.point2);
  const Pose end = free.end1();
  const Proximity there = find_plane_proximity(body.shape, end, upwards, offset);
  if (there.status == Status::InvalidInput) return std::nullopt;
  const double graze = kGraze * body.shape.half_extents().minCoeff();
  const bool swings_in = ahead.corner_count == 0 && -there.gap > held_back + graze;
  const bool is_free = there.gap > 0 && now.gap > 0 && held_back > now.error;
  if (!swings_in && !is_free) return std::nullopt;
  if (is_free && find_plane_time_of_impact(body.shape, free.motion1(), upwards, offset, time).may_hit()) return std::nullopt;
  ContactManifold contacts = find_plane_manifold_of_gaps(body.shape, end, there);
  free.take_back(1, contacts);
  contacts.reach = ahead.reach;
  if (swings_in) add_end(body, plane, time, 1, ahead, contacts);
  return contacts;
}

}  // namespace supernormal
