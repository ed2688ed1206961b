#include "kernel/walls/driven_wall.hpp"

#include <algorithm>
#include <utility>

namespace granular {

using falling_particles::WallPose;
using falling_particles::WallVelocity;

DrivenWall::DrivenWall(falling_particles::Drive drive, const WallPose& start)
    : drive_(std::move(drive)), axis_(start.rotation.conjugate() * drive_.axis), point_(Vector3::Zero()) {
  if (drive_.turns()) point_ = start.rotation.conjugate() * (*drive_.point - start.position);
}

Vector3 DrivenWall::axis_on(const WallPose& carrier) const { return carrier.rotation * axis_; }
Vector3 DrivenWall::point_on(const WallPose& carrier) const { return carrier(point_); }

WallPose DrivenWall::pose_on(const WallPose& carrier) const {
  WallPose pose = carrier;
  const Vector3 axis = axis_on(carrier);
  if (!drive_.turns()) {
    pose.position += state_.position * axis;
    return pose;
  }
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(state_.position, axis));
  const Vector3 point = point_on(carrier);
  pose.position = point + turn * (pose.position - point);
  pose.rotation = (turn * pose.rotation).normalized();
  return pose;
}

WallVelocity DrivenWall::velocity_on(const WallPose& carrier, const WallVelocity& velocity) const {
  const Vector3 axis = axis_on(carrier);
  const Vector3 position = pose_on(carrier).position;
  WallVelocity moved = velocity;
  moved.linear += velocity.angular.cross(position - carrier.position);
  if (drive_.turns()) {
    moved.angular += state_.speed * axis;
    moved.linear += state_.speed * axis.cross(position - point_on(carrier));
  } else {
    moved.linear += state_.speed * axis;
  }
  return moved;
}

double DrivenWall::weight_on(const WallPose& carrier, const Vector3& gravity) const {
  const Vector3 axis = axis_on(carrier);
  if (!drive_.turns()) return drive_.mass * axis.dot(gravity);
  return drive_.hung_mass * axis.dot((pose_on(carrier).position - point_on(carrier)).cross(gravity));
}

void DrivenWall::load(const WallPose& carrier, const Vector3& force, const Vector3& torque) {
  const Vector3 axis = axis_on(carrier);
  state_.load = drive_.turns() ? axis.dot(torque + (pose_on(carrier).position - point_on(carrier)).cross(force)) : axis.dot(force);
}

void DrivenWall::kick(const WallPose& carrier, const Vector3& gravity, double now, double step) {
  const bool pushes = now < drive_.until;
  state_.push = 0;
  if (now < drive_.from || (drive_.servo && !pushes)) {
    state_.speed = 0;
    return;
  }
  if (drive_.servo) {
    const auto& servo = *drive_.servo;
    state_.push = servo.area * servo.stress;
    state_.speed = std::clamp(servo.gain * (servo.stress - stress()), -servo.largest_speed, servo.largest_speed);
  } else {
    const double half = 0.5 * step;
    if (pushes) state_.push = push_of(drive_, state_.speed, half);
    const double force = state_.push + state_.load + weight_on(carrier, gravity);
    // Damping of the speed at the end of this half.
    state_.speed = (drive_.mass * state_.speed + half * force) / (drive_.mass + half * drive_.damping);
  }
  stop();
}

void DrivenWall::drift(double step) {
  state_.position = std::clamp(state_.position + step * state_.speed, drive_.travel[0], drive_.travel[1]);
  stop();
}

// A wall at an end of its travel has no speed out of it.
void DrivenWall::stop() {
  if (state_.position <= drive_.travel[0]) state_.speed = std::max(state_.speed, 0.0);
  if (state_.position >= drive_.travel[1]) state_.speed = std::min(state_.speed, 0.0);
}

}  // namespace granular
