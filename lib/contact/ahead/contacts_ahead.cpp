#include "supernormal/contact/contacts_ahead.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "contact/ahead/motion_in_step.hpp"
#include "contact/ahead/small_rotation.hpp"
#include "contact/manifold/common_corners.hpp"
#include "supernormal/impact/time_of_impact.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal {
namespace {

ContactManifold none(const Proximity& now, int evaluations) {
  ContactManifold manifold(now);
  manifold.deepest.status = Status::Apart;
  manifold.deepest.evaluations = evaluations;
  return manifold;
}

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

/// The contacts at the end of the free motion, the motion within `time` (s) without contact forces. Empty if the contacts `ahead`
/// are right for this motion.
///
/// A row of contact forces is linear in the motion and has one normal. The free motion bends: gravity bends the path of a body,
/// and the points of a rotating body move on circles. So contacts along the present velocity may forbid a motion that meets
/// nothing. At the end of this motion the bodies are apart by a gap. Rows with the normals of this place, and with this gap left
/// over by the free motion, forbid nothing of it. They keep the bodies apart if other forces change it. If the
/// bodies meet, these rows do not replace the contacts `ahead`.
///
/// A round body that rotates may overlap at the end by more than its one contact takes away: its other end swings in. Then the
/// manifold has both points, if they have one normal.
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
    limit_overlaps(contacts, 0);
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

double nearness(const MotionAhead& motion, double time, double size) { return nearness_of_both(motion, {}, time, size); }

double reach_towards(const MotionAhead& motion, const Vector3& direction, double time, double size) {
  return std::max(0.0, motion.velocity.dot(direction)) * time + nearness(motion, time, size);
}

ContactManifold find_contacts_ahead(const BodyAhead& body1, const BodyAhead& body2, double time, const Settings& settings,
                                    const Proximity& now) {
  if (now.status == Status::InvalidInput) return now;
  if (!is_finite(body1.motion) || !is_finite(body2.motion)) {
    return find_contacts_ahead({body1.shape, body1.pose, {}}, {body2.shape, body2.pose, {}}, time, settings, now);
  }
  const double share = share_of_first(body1.motion, body2.motion);
  const double size = smaller_thickness(body1.shape, body2.shape);
  const double near = nearness_of_both(body1.motion, body2.motion, time, size);
  const double reach = (body1.motion.velocity - body2.motion.velocity).norm() * time + near;
  if (now.gap > reach) return none(now, now.evaluations);
  const Meeting meeting = find_meeting(body1, body2, time, size, settings, now);
  if (!meeting.hits && meeting.time > 0 && meeting.there.gap > near) return none(now, meeting.evaluations);
  const BodyAhead there1 = moved(body1, meeting.time);
  const BodyAhead there2 = moved(body2, meeting.time);
  const Proximity& there = meeting.there;
  const double overlap = approach_of(body1.motion, body2.motion, time, there.normal, now.gap) +
                         growth_by_rotation(there1, there.normal, there.point1, time) +
                         growth_by_rotation(there2, -there.normal, there.point2, time);
  ContactManifold manifold = find_manifold_of_gaps(there1.shape, there1.pose, there2.shape, there2.pose, there, share, overlap);
  take_back(manifold, meeting.time * body1.motion.velocity, meeting.time * body2.motion.velocity, share, now.gap);
  manifold.deepest.evaluations = meeting.evaluations;
  manifold.reach = reach;
  limit_rotation(body1, body2, time, share, manifold);
  if (body1.motion.mobility > 0 && body2.motion.mobility > 0) {
    act_between_centres(body1, body2, time, share, meeting.time, manifold);
  }
  return find_after(TwoBodies{body1, body2, time, share, settings}, now, manifold).value_or(manifold);
}

// The tangent plane does not depend on the position of the body, and its gap shrinks linearly: no impact search is needed.
ContactManifold find_plane_contacts_ahead(const BodyAhead& body, double time, const Proximity& now) {
  if (now.status == Status::InvalidInput) return now;
  if (!is_finite(body.motion)) return find_plane_contacts_ahead({body.shape, body.pose, {}}, time, now);
  const double size = body.shape.half_extents().minCoeff();
  const double reach = reach_towards(body.motion, now.normal, time, size);
  if (now.gap > reach) return none(now, now.evaluations);
  const double overlap =
      approach_of(body.motion, {}, time, now.normal, now.gap) + growth_by_rotation(body, now.normal, now.point1, time);
  ContactManifold manifold = find_plane_manifold_of_gaps(body.shape, body.pose, now, overlap);
  manifold.reach = reach;
  limit_rotation(body, {body.shape, body.pose, {}}, time, 1, manifold);
  if (body.motion.angular_velocity.isZero(0) && body.motion.angular_acceleration.isZero(0)) return manifold;
  const Vector3 upwards = -now.normal;
  return find_after(BodyAndPlane{body, time, upwards, upwards.dot(now.point2)}, now, manifold).value_or(manifold);
}

}  // namespace supernormal
