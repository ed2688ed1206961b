#include "driven_body.hpp"

#include <algorithm>
#include <cmath>

#include "grain.hpp"

namespace falling_particles {
namespace {

// The joint prevents all other motion. A body with a large inertia hardly moves that way by itself, and leaves less work to the
// solver. In shear_cell.toml the final overlap of grains is 5.7 % of the smallest half-axis. With an inertia of m r^2 it is 7.0 %.
constexpr double kHeavy = 1e3;

// m or rad, by which the stops of the joint are inside the travel. So a wall at the end of its travel, which is exact, is at the
// stop of the joint for any rounding of poses. It is 1e4 times the rounding of a position of 1 km, and without effect on any
// position.
constexpr double kInside = 1e-9;

double radius_of(const Wall& wall) {
  const double radius = bounding_radius(wall.shape);
  return std::isfinite(radius) ? radius : 1;
}

/// Iterations for the middle of a turn, which gain a factor of up to step x spin / 2 each. The energy of the plate of the tests,
/// which turns by 0.05 rad in a step, oscillates by 5e-5 with half of them, with twice of them too. With two it drifts by 1e-3 in
/// 20 000 steps, and without any it doubles.
constexpr int kMidpointIterations = 8;

/// kg m^2, in the world's frame.
Eigen::Matrix3d turned(const Eigen::Matrix3d& inertia, const Eigen::Quaterniond& rotation) {
  return rotation * inertia * rotation.conjugate();
}

}  // namespace

DrivenBody::DrivenBody(dWorldID world, dBodyID carrier, const Wall& wall, double step)
    : world_(world), wall_(wall), drive_(*wall.drive), axis_(drive_, wall.start), step_(step), body_(create_wall_body(world)) {
  // Weight is a force of its own: the mass of the body is another one where damping is in it.
  dBodySetGravityMode(body_, 0);
  dBodySetGyroscopicMode(body_, 0);
  set_inertia(drive_.servo ? 1 : drive_.mass);
  put(wall.start, {});
  const Vector3& axis = drive_.axis;
  if (drive_.turns()) {
    joint_ = dJointCreateHinge(world, nullptr);
    dJointAttach(joint_, body_, carrier);
    dJointSetHingeAnchor(joint_, drive_.point->x(), drive_.point->y(), drive_.point->z());
    dJointSetHingeAxis(joint_, axis.x(), axis.y(), axis.z());
  } else {
    joint_ = dJointCreateSlider(world, nullptr);
    dJointAttach(joint_, body_, carrier);
    dJointSetSliderAxis(joint_, axis.x(), axis.y(), axis.z());
  }
  const auto [low, high] = drive_.travel;
  const auto set = drive_.turns() ? dJointSetHingeParam : dJointSetSliderParam;
  const double inside = std::min(kInside, (high - low) / 4);
  if (std::isfinite(low)) set(joint_, dParamLoStop, low + inside);
  if (std::isfinite(high)) set(joint_, dParamHiStop, high - inside);
  set(joint_, dParamStopERP, 0);  // read() ends at the travel
  if (drive_.servo) dJointSetFeedback(joint_, &feedback_);
}

DrivenBody::~DrivenBody() {
  dJointDestroy(joint_);
  dBodyDestroy(body_);
}

void DrivenBody::set_inertia(double inertia) {
  if (inertia == inertia_) return;
  inertia_ = inertia;
  const double radius = radius_of(wall_);
  dMass mass;
  if (!drive_.turns()) {
    const double across = kHeavy * inertia * radius * radius;
    dMassSetParameters(&mass, inertia, 0, 0, 0, across, across, across, 0, 0, 0);
  } else {
    const Vector3 axis = wall_.start.rotation.conjugate() * drive_.axis;
    const Eigen::Matrix3d about = axis * axis.transpose();
    const Eigen::Matrix3d tensor = inertia * (kHeavy * (Eigen::Matrix3d::Identity() - about) + about);
    dMassSetParameters(&mass, kHeavy * inertia / (radius * radius), 0, 0, 0, tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1),
                       tensor(0, 2), tensor(1, 2));
  }
  dBodySetMass(body_, &mass);
}

int DrivenBody::rows() const {
  constexpr int kOfJoint = 5;  // of a slider or a hinge, and one at a stop
  const auto [low, high] = drive_.travel;
  const double inside = std::min(kInside, (high - low) / 4);
  const bool is_at_stop = state_.position <= low + inside || state_.position >= high - inside;
  return dBodyIsEnabled(body_) != 0 ? kOfJoint + (is_at_stop ? 1 : 0) : 0;
}

WallPose DrivenBody::pose_on(const WallPose& carrier) const { return axis_.pose_on(carrier, state_.position); }

WallPose DrivenBody::next_on(const WallPose& carrier) const {
  return axis_.pose_on(carrier, state_.position + step_ * state_.speed);
}

WallVelocity DrivenBody::velocity_on(const WallPose& carrier, const WallVelocity& velocity) const {
  return axis_.velocity_on(carrier, velocity, state_.position, state_.speed);
}

double DrivenBody::weight_on(const WallPose& carrier) const {
  dVector3 gravity;
  dWorldGetGravity(world_, gravity);
  return axis_.weight_on(carrier, state_.position, to_vector(gravity));
}

// The speed stays below its limit if the load is the same as in the last step.
double DrivenBody::push_of_servo(const Servo& servo, double area) const {
  const double at_limit = area / servo.gain * servo.largest_speed;
  return std::clamp(area * servo.stress, state_.load - at_limit, state_.load + at_limit);
}

// Damping is implicit, in contact too: the solver finds m (v' - v) / step = push - damping v' + load, if the body has the mass
// m + step damping and the force push - damping v. A servo is a wall with this damping and no mass. v and v' are relative to the
// carrier as it moves in this step, also if it had another velocity before.
void DrivenBody::push(const WallPose& carrier, double now, double area) {
  const double slack = 1e-6 * step_;  // times of steps are rounded
  const bool pushes = now + slack < drive_.until;
  is_held_ = now + slack < drive_.from || (drive_.servo && !pushes);
  state_.push = 0;
  if (is_held_) return;
  const double speed = drive_.turns() ? dJointGetHingeAngleRate(joint_) : dJointGetSliderPositionRate(joint_);
  double damping = drive_.damping;
  if (drive_.servo) {
    damping = area / drive_.servo->gain;
    state_.push = push_of_servo(*drive_.servo, area);
    set_inertia(step_ * damping);
  } else {
    if (pushes) state_.push = push_of(drive_, speed, step_);
    set_inertia(drive_.mass + step_ * damping);
  }
  dBodyEnable(body_);
  const Vector3 force = (state_.push + weight_on(carrier) - damping * speed) * axis_.axis_on(carrier);
  (drive_.turns() ? dBodyAddTorque : dBodyAddForce)(body_, force.x(), force.y(), force.z());
}

void DrivenBody::read(const WallPose& carrier, const WallVelocity& velocity) {
  if (is_held_) {
    state_.speed = state_.load = 0;
    return;
  }
  const Vector3 axis = axis_.axis_on(carrier);
  if (drive_.turns()) {
    state_.speed = axis.dot(to_vector(dBodyGetAngularVel(body_)) - velocity.angular);
  } else {
    state_.speed = axis.dot(to_vector(dBodyGetLinearVel(body_)) - velocity.linear);
  }
  if (drive_.servo) {
    // The wall has no mass: what pushes it is what the damping takes, the grains and a stop.
    state_.load = state_.push + axis.dot(to_vector(feedback_.f1)) - inertia_ / step_ * state_.speed;
    state_.speed = std::clamp(state_.speed, -drive_.servo->largest_speed, drive_.servo->largest_speed);
  }
  const double from = state_.position;
  const double to = from + step_ * state_.speed;
  state_.position = std::clamp(to, drive_.travel[0], drive_.travel[1]);
  if (state_.position != to) state_.speed = (state_.position - from) / step_;  // ODE notices a stop a step after it is passed
}

void DrivenBody::put(const WallPose& carrier, const WallVelocity& velocity) {
  const WallPose pose = pose_on(carrier);
  const WallVelocity moves = velocity_on(carrier, velocity);
  if (!drive_.turns()) {
    set_pose(body_, pose);
    set_velocity(body_, moves);
    return;
  }
  const Vector3 point = axis_.point_on(carrier);
  set_pose(body_, {point, pose.rotation});
  set_velocity(body_, {velocity.linear + velocity.angular.cross(point - carrier.position), moves.angular});
}

FlyingBody::FlyingBody(dWorldID world, const Wall& wall, double step, bool is_of_stepper)
    : flight_(*wall.flight),
      step_(step),
      is_of_stepper_(is_of_stepper),
      inverse_inertia_(flight_.inertia.inverse()),
      body_(create_wall_body(world)) {
  if (!is_of_stepper) dBodySetGyroscopicMode(body_, 0);  // read() keeps the angular momentum
  dMass mass;
  const Eigen::Matrix3d& I = flight_.inertia;
  dMassSetParameters(&mass, flight_.mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  dBodySetMass(body_, &mass);
  state_ = {flight_.velocity.linear, turned(I, wall.start.rotation) * flight_.velocity.angular};
  put(wall.start);
  dBodyDisable(body_);
}

FlyingBody::~FlyingBody() { dBodyDestroy(body_); }

void FlyingBody::before_step(double now) {
  const double slack = 1e-6 * step_;  // times of steps are rounded
  is_held_ = now + slack < flight_.from;
  is_held_ ? dBodyDisable(body_) : dBodyEnable(body_);
}

WallPose FlyingBody::read(const WallPose& pose) {
  const dReal* const q = dBodyGetQuaternion(body_);
  const Eigen::Quaterniond rotation = is_of_stepper_ ? Eigen::Quaterniond(q[0], q[1], q[2], q[3]) : pose.rotation;
  state_ = {to_vector(dBodyGetLinearVel(body_)), turned(flight_.inertia, rotation) * to_vector(dBodyGetAngularVel(body_))};
  if (!is_of_stepper_) return next(pose, step_);
  return {to_vector(dBodyGetPosition(body_)) - rotation * flight_.centre, rotation};
}

void FlyingBody::put(const WallPose& pose) {
  set_pose(body_, centred(pose));
  set_velocity(body_, {state_.velocity, spin(pose.rotation)});
}

WallPose FlyingBody::centred(const WallPose& pose) const { return {pose(flight_.centre), pose.rotation}; }

Vector3 FlyingBody::spin(const Eigen::Quaterniond& rotation) const { return turned(inverse_inertia_, rotation) * state_.momentum; }

// The implicit midpoint rule with a constant angular momentum. It is symmetric in time, so the energy of a free turn does not
// drift.
WallPose FlyingBody::next(const WallPose& pose, double time) const {
  Vector3 turn = time * spin(pose.rotation);
  for (int i = 0; i < kMidpointIterations; ++i) turn = time * spin(rotation_by(turn / 2) * pose.rotation);
  const Eigen::Quaterniond rotation = (rotation_by(turn) * pose.rotation).normalized();
  return {pose(flight_.centre) + time * state_.velocity - rotation * flight_.centre, rotation};
}

}  // namespace falling_particles
