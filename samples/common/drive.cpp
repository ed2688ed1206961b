#include "common/drive.hpp"

#include <algorithm>
#include <cmath>

namespace common {

double push_of(const Drive& drive, double speed, double step) {
  if (drive.power == 0 || speed < 0) return drive.force;
  // The speed that has the energy of the end of the step. The power acts at the mean of both speeds.
  const double then = std::sqrt(speed * speed + 2 * step * drive.power / drive.mass);
  return std::min(drive.force, 2 * drive.power / (speed + then));
}

DrivenAxis::DrivenAxis(const Drive& drive, const WallPose& start)
    : axis_(drive.axis), to_wall_(start.rotation.conjugate()), weighing_(drive.turns() ? drive.hung_mass : drive.mass) {
  if (drive.turns()) anchor_ = to_wall_ * (*drive.point - start.position);
}

Vector3 DrivenAxis::axis_on(const WallPose& carrier) const { return carrier.rotation * to_wall_ * axis_; }

Vector3 DrivenAxis::point_on(const WallPose& carrier) const { return carrier(*anchor_); }

WallPose DrivenAxis::pose_on(const WallPose& carrier, double position) const {
  WallPose pose = carrier;
  const Vector3 axis = axis_on(carrier);
  if (!anchor_) {
    pose.position += position * axis;
    return pose;
  }
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(position, axis));
  const Vector3 point = point_on(carrier);
  pose.position = point + turn * (pose.position - point);
  pose.rotation = (turn * pose.rotation).normalized();
  return pose;
}

WallVelocity DrivenAxis::velocity_on(const WallPose& carrier, const WallVelocity& velocity, double position, double speed) const {
  const Vector3 axis = axis_on(carrier);
  const Vector3 place = pose_on(carrier, position).position;
  WallVelocity moved = velocity;
  moved.linear += velocity.angular.cross(place - carrier.position);
  if (anchor_) {
    moved.angular += speed * axis;
    moved.linear += speed * axis.cross(place - point_on(carrier));
  } else {
    moved.linear += speed * axis;
  }
  return moved;
}

double DrivenAxis::weight_on(const WallPose& carrier, double position, const Vector3& gravity) const {
  const Vector3 axis = axis_on(carrier);
  if (!anchor_) return weighing_ * axis.dot(gravity);
  return weighing_ * axis.dot((pose_on(carrier, position).position - point_on(carrier)).cross(gravity));
}

}  // namespace common
