#include "contact/ahead/free_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace supernormal {

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

}  // namespace supernormal
