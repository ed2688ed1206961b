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

// Two contacts with normals that differ by less than this have one normal. With 0 there is no second contact: of 200 needles of
// 20 : 1 that fall on a plane, 116 come in by more than a half-width. With 1e-9 12 do.
constexpr double kParallel = 1e-6;

// rad; the end of a body that turns farther in a step says nothing about its way there. Without the limit, 7 of 6000 bullets with
// friction go through walls; with it 1.
constexpr double kMostTurn = 1;

/// Upper bound of what another point of the bodies approaches more than a contact, by rotation, m.
double most_swing(const MotionAhead& motion1, const MotionAhead& motion2, double time) {
  return 2 * (shift_by_rotation(motion1, time) + shift_by_rotation(motion2, time));
}

/// Two single contacts of a round body with the same normal, now and at the end of the free motion, as one manifold.
template <class Pair>
void add_end(const Pair& pair, const ContactManifold& ahead, ContactManifold& contacts) {
  limit_rotation(pair.body1, pair.body2, pair.time, pair.share, contacts);
  const ManifoldCorner end{contacts.deepest.contact, -contacts.deepest.gap};
  const ManifoldCorner now{ahead.deepest.contact, -ahead.deepest.gap};
  if (now.depth > end.depth) contacts.deepest = ahead.deepest;
  contacts.corners = {now, now, end, end};
  contacts.corner_count = ContactManifold::kMaxCorners;
  contacts.same_place = kSamePlace * smaller_thickness(pair.body1.shape, pair.body2.shape);
  contacts.shallow = kShallow * contacts.same_place;
}

/// Two bodies that move freely. `planes`: the gap of the tangent planes at the end of a motion. `impact`: the first on the way.
struct TwoBodies {
  const BodyAhead& body1;
  const BodyAhead& body2;
  double time;   // s
  double share;  // of body 1 in the gap, where contacts are
  const Settings& settings;

  double planes(const FreeMotion& motion, const Vector3& normal) const {
    GapJet jet;
    const Pose end1 = motion.end1();
    GapFunction(body1.shape, end1, body2.shape, motion.end2()).evaluate(end1.rotation.transpose() * normal, Order::Point, jet);
    return jet.s;
  }
  Proximity proximity(const FreeMotion& motion, const Vector3& normal) const {
    const Pose end1 = motion.end1();
    const Vector3 first = end1.rotation.transpose() * normal;
    return find_proximity(body1.shape, end1, body2.shape, motion.end2(), settings, &first);
  }
  ContactManifold manifold(const FreeMotion& motion, const Proximity& there) const {
    // The contact of an overlap is within both bodies, but no overlap remains.
    Proximity touching = there;
    touching.contact = share * there.point1 + (1 - share) * there.point2 + (share - 0.5) * there.gap * there.normal;
    return find_manifold_of_gaps(body1.shape, motion.end1(), body2.shape, motion.end2(), touching, share);
  }
  Impact impact(const FreeMotion& motion, const Vector3& normal) const {
    const Vector3 first = body1.pose.rotation.transpose() * normal;
    return find_time_of_impact(body1.shape, motion.motion1(), body2.shape, motion.motion2(), time, settings, &first);
  }
};

/// A body and a plane at rest. Body 2 has the shape of body 1, but no motion.
struct BodyAndPlane {
  const BodyAhead& body1;
  double time;      // s
  Vector3 upwards;  // unit, world frame
  double offset;    // m
  BodyAhead body2{body1.shape, body1.pose, {}};
  double share = 1;
  Settings settings{};

  double planes(const FreeMotion& motion, const Vector3& normal) const { return proximity(motion, normal).gap; }
  Proximity proximity(const FreeMotion& motion, const Vector3& /*normal*/) const {
    return find_plane_proximity(body1.shape, motion.end1(), upwards, offset);
  }
  ContactManifold manifold(const FreeMotion& motion, const Proximity& there) const {
    return find_plane_manifold_of_gaps(body1.shape, motion.end1(), there);
  }
  Impact impact(const FreeMotion& motion, const Vector3& /*normal*/) const {
    return find_plane_time_of_impact(body1.shape, motion.motion1(), upwards, offset, time);
  }
};

/// The contacts after the free motion of a pair, in place of those of `now` and `ahead`.
template <class Pair>
std::optional<ContactManifold> find_after(const Pair& pair, const Proximity& now, const ContactManifold& ahead) {
  const FreeMotion free(pair.body1, pair.body2, pair.time);
  const double held_back = free.bends() ? free.held_back_by(ahead) : 0;
  const double size = smaller_thickness(pair.body1.shape, pair.body2.shape);
  const double graze = kGraze * size;
  const bool may_be_free = now.gap > 0 && held_back > now.error;
  const double turn = pair.time * std::max(pair.body1.motion.angular_velocity.norm(), pair.body2.motion.angular_velocity.norm());
  const bool may_swing_in =
      ahead.corner_count == 0 && turn < kMostTurn && most_swing(pair.body1.motion, pair.body2.motion, pair.time) > graze;
  const Vector3& normal = ahead.deepest.normal;
  int evaluations = ahead.deepest.evaluations;
  if (!may_be_free) {
    if (!may_swing_in) return std::nullopt;
    ++evaluations;
    // The tangent planes with the normal of the contact prove that the end is no deeper than they say.
    if (!(-pair.planes(free, normal) > held_back + graze)) return std::nullopt;
  }
  const auto contacts_at = [&](const FreeMotion& motion, const Proximity& end) {
    ContactManifold contacts = pair.manifold(motion, end);
    motion.take_back(pair.share, contacts);
    contacts.reach = ahead.reach;
    return contacts;
  };
  const Proximity there = pair.proximity(free, normal);
  if (there.status == Status::InvalidInput) return std::nullopt;
  evaluations += there.evaluations;
  if (may_swing_in && -there.gap > held_back + graze && (there.normal - normal).norm() < kParallel) {
    ContactManifold contacts = contacts_at(free, there);
    remove_overlaps(contacts);
    add_end(pair, ahead, contacts);
    contacts.deepest.evaluations = evaluations;
    return contacts;
  }
  if (!may_be_free || !(there.gap > 0)) return std::nullopt;
  const auto contacts_after = [&](const FreeMotion& motion) -> std::optional<ContactManifold> {
    const Proximity end = &motion == &free ? there : pair.proximity(motion, normal);
    if (&motion != &free) evaluations += end.evaluations;
    if (end.status == Status::InvalidInput || !(end.gap > 0)) return std::nullopt;
    const Impact first = pair.impact(motion, now.normal);
    evaluations += first.evaluations;
    if (first.may_hit()) return std::nullopt;
    return contacts_at(motion, end);
  };
  const FreeMotion borne(without_forces(pair.body1), without_forces(pair.body2), pair.time);
  std::optional<ContactManifold> contacts = choose_contacts(free, borne, graze, pair.settings.tolerance * size, contacts_after);
  if (contacts) contacts->deepest.evaluations = evaluations;
  return contacts;
}

}  // namespace

FreeMotion::FreeMotion(const BodyAhead& body1, const BodyAhead& body2, double time)
    : time_(time), centre1_(body1.motion.centre), centre2_(body2.motion.centre), motion1_(of(body1)), motion2_(of(body2)) {
  const bool rotates = !motion1_.angular_velocity.isZero(0) || !motion2_.angular_velocity.isZero(0);
  bends_ = rotates || body1.motion.acceleration != body2.motion.acceleration;
}

Motion FreeMotion::of(const BodyAhead& body) const {
  const MotionAhead& motion = body.motion;
  const Vector3 to_centre = motion.centre - body.pose.position;
  return {body.pose, motion.velocity + time_ * motion.acceleration + motion.angular_velocity.cross(to_centre),
          motion.angular_velocity + time_ * motion.angular_acceleration, body.pose.rotation.transpose() * to_centre};
}

double FreeMotion::closed_at(const Vector3& place, const Vector3& normal) const {
  const Vector3 velocity1 = motion1_.velocity + motion1_.angular_velocity.cross(place - centre1_);
  const Vector3 velocity2 = motion2_.velocity + motion2_.angular_velocity.cross(place - centre2_);
  return time_ * normal.dot(velocity1 - velocity2);
}

double FreeMotion::held_back_by(const ContactManifold& contacts) const {
  const Proximity& deepest = contacts.deepest;
  if (contacts.corner_count == 0) return std::max(0.0, closed_at(deepest.contact, deepest.normal) - deepest.gap);
  double most = 0;
  for (const ManifoldCorner& corner : contacts.corners)
    most = std::max(most, closed_at(corner.point, deepest.normal) + corner.depth);
  return most;
}

void FreeMotion::stop_at(const ContactManifold& contacts) {
  motion1_.velocity -= held_back_by(contacts) / time_ * contacts.deepest.normal;
}

void FreeMotion::take_back(double share, ContactManifold& contacts) const {
  const Vector3 displacement = time_ * (share * motion1_.velocity + (1 - share) * motion2_.velocity);
  Proximity& deepest = contacts.deepest;
  deepest.point1 -= time_ * motion1_.velocity;
  deepest.point2 -= time_ * motion2_.velocity;
  deepest.contact -= displacement;
  deepest.gap += closed_at(deepest.contact, deepest.normal);
  if (contacts.placed_on) contacts.placed_on->pose.position -= displacement;
  for (ManifoldCorner& corner : contacts.corners) {
    corner.point -= displacement;
    corner.depth -= closed_at(corner.point, deepest.normal);
  }
}

BodyAhead without_forces(BodyAhead body) {
  body.motion.acceleration.setZero();
  body.motion.angular_acceleration.setZero();
  return body;
}

void remove_overlaps(ContactManifold& contacts) {
  contacts.deepest.gap = std::max(0.0, contacts.deepest.gap);
  for (ManifoldCorner& corner : contacts.corners) corner.depth = std::min(0.0, corner.depth);
}

std::optional<ContactManifold> find_contacts_after_free_motion(const BodyAhead& body1, const BodyAhead& body2, double time,
                                                               double share, const Settings& settings, const Proximity& now,
                                                               const ContactManifold& ahead) {
  return find_after(TwoBodies{body1, body2, time, share, settings}, now, ahead);
}

std::optional<ContactManifold> find_plane_contacts_after_free_motion(const BodyAhead& body, double time, const Proximity& now,
                                                                     const ContactManifold& ahead) {
  if (body.motion.angular_velocity.isZero(0) && body.motion.angular_acceleration.isZero(0)) return std::nullopt;
  const Vector3 upwards = -now.normal;
  return find_after(BodyAndPlane{body, time, upwards, upwards.dot(now.point2)}, now, ahead);
}

}  // namespace supernormal
