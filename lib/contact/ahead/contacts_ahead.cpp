#include "supernormal/contact/contacts_ahead.hpp"

#include <algorithm>
#include <cmath>

#include "base/validation.hpp"
#include "contact/ahead/free_motion.hpp"
#include "contact/ahead/meeting.hpp"
#include "contact/ahead/nearness.hpp"
#include "contact/ahead/small_rotation.hpp"

namespace supernormal {
namespace {

ContactManifold none(const Proximity& now, int evaluations) {
  ContactManifold manifold(now);
  manifold.deepest.status = Status::Apart;
  manifold.deepest.evaluations = evaluations;
  return manifold;
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
  return find_contacts_after_free_motion(body1, body2, time, share, settings, now, manifold).value_or(manifold);
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
  return find_plane_contacts_after_free_motion(body, time, now, manifold).value_or(manifold);
}

}  // namespace supernormal
