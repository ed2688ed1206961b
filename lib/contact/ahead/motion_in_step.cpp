#include "contact/ahead/motion_in_step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/validation.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal {
namespace {

// A displacement below this fraction of the overlap changes no contact: the present poses suffice.
constexpr double kNoWay = 0.1;

// An impact is accurate enough once the bodies overlap by this fraction of the overlap asked for.
constexpr double kMet = 0.9;

// Newton's method takes two or three steps. If it reaches this limit, the last position counts as the impact.
constexpr int kMostSteps = 30;

/// Moves contacts back by the mean displacement of the bodies, m. `closed_at(place)`: how much of the gap at a place, where it is
/// now, the motion closes, m.
template <class Closed>
void move_back(ContactManifold& contacts, const Vector3& displacement, double share, const Closed& closed_at) {
  Proximity& deepest = contacts.deepest;
  deepest.contact -= displacement;
  deepest.gap += closed_at(deepest.contact);
  if (contacts.placed_on) contacts.placed_on->pose.position -= displacement;
  for (ManifoldCorner& corner : contacts.corners) {
    corner.point -= displacement;
    corner.depth -= closed_at(corner.point);
  }
  // Rotation makes another corner the deepest.
  for (int k = 0; k < contacts.corner_count; ++k) {
    const ManifoldCorner& corner = contacts.corners[static_cast<std::size_t>(k)];
    if (corner.depth <= -deepest.gap) continue;
    deepest.gap = -corner.depth;
    deepest.contact = corner.point;
  }
  deepest.point1 = deepest.contact - (1 - share) * deepest.gap * deepest.normal;
  deepest.point2 = deepest.contact + share * deepest.gap * deepest.normal;
}

}  // namespace

double smaller_thickness(const Shape& shape1, const Shape& shape2) {
  const double thickness1 = shape1.half_extents().minCoeff();
  const double thickness2 = shape2.half_extents().minCoeff();
  if (thickness1 < kMinLength) return thickness2;
  return thickness2 < kMinLength ? thickness1 : std::min(thickness1, thickness2);
}

BodyAhead moved(const BodyAhead& body, double time) {
  return {body.shape, {body.pose.position + time * body.motion.velocity, body.pose.rotation}, body.motion};
}

void take_back(ContactManifold& manifold, const Vector3& displacement1, const Vector3& displacement2, double share, double gap) {
  const double closed = manifold.deepest.normal.dot(displacement1 - displacement2);
  const Vector3 displacement = share * displacement1 + (1 - share) * displacement2;
  move_back(manifold, displacement, share, [&](const Vector3& /*place*/) { return closed; });
  limit_overlaps(manifold, std::max(0.0, -gap));
}

Meeting find_meeting(const BodyAhead& body1, const BodyAhead& body2, double time, double size, const Settings& settings,
                     const Proximity& now) {
  const double graze = kGraze * size;
  const Vector3 velocity = body1.motion.velocity - body2.motion.velocity;
  const Meeting of_now{0, now, now.gap <= -graze, now.evaluations};
  if (of_now.hits || velocity.norm() * time <= kNoWay * graze) return of_now;
  Meeting meeting = of_now;
  const auto go_to = [&](double later) {
    const BodyAhead there1 = moved(body1, later);
    const BodyAhead there2 = moved(body2, later);
    const Vector3 normal = body1.pose.rotation.transpose() * meeting.there.normal;
    meeting.time = later;
    meeting.there = find_proximity(there1.shape, there1.pose, there2.shape, there2.pose, settings, &normal);
    meeting.evaluations += meeting.there.evaluations;
    meeting.hits = meeting.there.gap <= -kMet * graze;
    return meeting.there.status != Status::InvalidInput;
  };
  for (int step = 0; !meeting.hits; ++step) {
    const double closing = velocity.dot(meeting.there.normal);
    const double left = meeting.there.gap + graze;
    if (!(closing > 0 && closing * (time - meeting.time) > left)) break;
    if (!go_to(meeting.time + left / closing)) return of_now;
    if (step == kMostSteps) meeting.hits = true;
  }
  if (!meeting.hits && !go_to(time)) return of_now;
  return meeting;
}

FreeMotion::FreeMotion(const BodyAhead& body1, const BodyAhead& body2, double time)
    : time_(time),
      centre1_(body1.motion.centre),
      centre2_(body2.motion.centre),
      motion1_(of(body1)),
      motion2_(of(body2)),
      turning1_(turning_of(body1.motion)),
      turning2_(turning_of(body2.motion)) {
  const bool rotates = !motion1_.angular_velocity.isZero(0) || !motion2_.angular_velocity.isZero(0);
  bends_ = rotates || body1.motion.acceleration != body2.motion.acceleration;
}

Vector3 FreeMotion::turning_of(const MotionAhead& motion) const {
  return motion.angular_velocity + time_ * motion.angular_acceleration;
}

Motion FreeMotion::of(const BodyAhead& body) const {
  const MotionAhead& motion = body.motion;
  const Vector3 to_centre = motion.centre - body.pose.position;
  const Vector3 turning = turning_of(motion);
  const double half = 0.5 * time_ * turning.norm();
  const double part = motion.turns_along_tangent && half > 0 ? std::atan(half) / half : 1;
  return {body.pose, motion.velocity + time_ * motion.acceleration + motion.angular_velocity.cross(to_centre), part * turning,
          body.pose.rotation.transpose() * to_centre};
}

double FreeMotion::closed_at(const Vector3& place, const Vector3& normal) const {
  const Vector3 velocity1 = motion1_.velocity + turning1_.cross(place - centre1_);
  const Vector3 velocity2 = motion2_.velocity + turning2_.cross(place - centre2_);
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
  const auto closed = [&](const Vector3& place) { return closed_at(place, contacts.deepest.normal); };
  move_back(contacts, time_ * (share * motion1_.velocity + (1 - share) * motion2_.velocity), share, closed);
}

BodyAhead without_forces(BodyAhead body) {
  body.motion.acceleration.setZero();
  body.motion.angular_acceleration.setZero();
  return body;
}

void limit_overlaps(ContactManifold& contacts, double greatest_depth) {
  contacts.deepest.gap = std::max(-greatest_depth, contacts.deepest.gap);
  for (ManifoldCorner& corner : contacts.corners) corner.depth = std::min(greatest_depth, corner.depth);
}

}  // namespace supernormal
