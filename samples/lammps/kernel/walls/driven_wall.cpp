#include "kernel/walls/driven_wall.hpp"

#include <algorithm>
#include <utility>

namespace granular {

using common::WallPose;
using common::WallVelocity;

DrivenWall::DrivenWall(common::Drive drive, const WallPose& start) : drive_(std::move(drive)), axis_(drive_, start) {}

WallPose DrivenWall::pose_on(const WallPose& carrier) const { return axis_.pose_on(carrier, state_.position); }

WallVelocity DrivenWall::velocity_on(const WallPose& carrier, const WallVelocity& velocity) const {
  return axis_.velocity_on(carrier, velocity, state_.position, state_.speed);
}

void DrivenWall::load(const WallPose& carrier, const Vector3& force, const Vector3& torque) {
  const Vector3 axis = axis_.axis_on(carrier);
  state_.load =
      drive_.turns() ? axis.dot(torque + (pose_on(carrier).position - axis_.point_on(carrier)).cross(force)) : axis.dot(force);
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
    const double force = state_.push + state_.load + axis_.weight_on(carrier, state_.position, gravity);
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
