// The bodies of walls that a force, a torque or their contacts move.
#pragma once

#include <ode/ode.h>

#include "common/motion.hpp"
#include "model/wall.hpp"

namespace falling_particles {

using namespace common;

/// A body without automatic sleep and without damping.
inline dBodyID create_wall_body(dWorldID world) {
  const dBodyID body = dBodyCreate(world);
  dBodySetAutoDisableFlag(body, 0);
  dBodySetLinearDamping(body, 0);
  dBodySetAngularDamping(body, 0);
  return body;
}

inline void set_velocity(dBodyID body, const WallVelocity& velocity) {
  dBodySetLinearVel(body, velocity.linear.x(), velocity.linear.y(), velocity.linear.z());
  dBodySetAngularVel(body, velocity.angular.x(), velocity.angular.y(), velocity.angular.z());
}

inline void set_pose(dBodyID body, const WallPose& pose) {
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
  const dQuaternion q = {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()};
  dBodySetQuaternion(body, q);
}

/// The state of a driven wall between two steps.
struct DrivenState {
  double position = 0;  ///< m along the axis, or rad about it
  double speed = 0;     ///< m/s or rad/s
  double push = 0;      ///< N or N m, of the drive in the last step
  double load = 0;      ///< N, of the grains against the axis in the last step, on a servo

  void serialize(auto& archive) { archive(position, speed, push, load); }
};

/// A body with inertia on a joint to the kinematic body of its wall, its carrier. The joint leaves one degree of freedom: along the
/// axis of the drive, or about it.
class DrivenBody {
 public:
  /// The wall and the carrier must outlive this object. `step`: s.
  DrivenBody(dWorldID world, dBodyID carrier, const Wall& wall, double step);
  ~DrivenBody();
  DrivenBody(const DrivenBody&) = delete;
  DrivenBody& operator=(const DrivenBody&) = delete;

  /// Adds the forces of the step that starts at `now` (s). `carrier`: the pose of the carrier; `area`: m^2, of a servo.
  void push(const WallPose& carrier, double now, double area);
  /// Reads the position and the speed after the step. `carrier` and `velocity` belong to the carrier in the step.
  void read(const WallPose& carrier, const WallVelocity& velocity);
  /// Sets the body to its pose on the carrier. So what the solver leaves across the joint is discarded.
  void put(const WallPose& carrier, const WallVelocity& velocity);

  dBodyID id() const { return body_; }
  int rows() const;                                 ///< of the solver, of the joint to the carrier
  bool is_held() const { return is_held_; }         ///< whether the wall cannot move relative to its carrier, in this step
  WallPose pose_on(const WallPose& carrier) const;  ///< of the wall
  WallVelocity velocity_on(const WallPose& carrier, const WallVelocity& velocity) const;
  /// The pose at the end of the step on the same carrier, if the speed stayed the same.
  WallPose next_on(const WallPose& carrier) const;

  const DrivenState& state() const { return state_; }
  void restore(const DrivenState& state) { state_ = state; }

 private:
  double weight_on(const WallPose& carrier) const;
  double push_of_servo(const Servo& servo, double area) const;
  void set_inertia(double inertia);

  dWorldID world_;
  const Wall& wall_;
  const Drive& drive_;
  DrivenAxis axis_;
  double step_;
  dBodyID body_;
  dJointID joint_;
  dJointFeedback feedback_ = {};  // of the joint of a servo: the force of a stop
  double inertia_ = 0;            // of the body, in the units of Drive::mass
  DrivenState state_;
  bool is_held_ = true;
};

/// The state of a free wall between two steps.
struct FlightState {
  Vector3 velocity = Vector3::Zero();  ///< m/s, of the centre of mass
  Vector3 momentum = Vector3::Zero();  ///< kg m^2/s, angular, about the centre of mass

  void serialize(auto& archive) {
    for (Vector3* vector : {&velocity, &momentum}) archive((*vector)[0], (*vector)[1], (*vector)[2]);
  }
};

/// A body with the inertia of its wall, at the wall's centre of mass. Quickstep finds its momenta; this class finds its poses.
/// Quickstep would let the angular momentum of a body drift that turns freely about no principal axis. The stepper does not, and
/// finds the poses too.
class FlyingBody {
 public:
  /// The wall must outlive this object. `step`: s.
  FlyingBody(dWorldID world, const Wall& wall, double step, bool is_of_stepper = false);
  ~FlyingBody();
  FlyingBody(const FlyingBody&) = delete;
  FlyingBody& operator=(const FlyingBody&) = delete;

  /// Holds or releases the body for the step that starts at `now` (s).
  void before_step(double now);
  /// Reads the momenta after the step, and returns the pose of the wall that was in `pose` before it.
  WallPose read(const WallPose& pose);
  /// Sets the body to the pose of its wall.
  void put(const WallPose& pose);

  dBodyID id() const { return body_; }
  bool is_held() const { return is_held_; }
  WallPose centred(const WallPose& pose) const;            ///< of the centre of mass of a wall in `pose`
  WallPose next(const WallPose& pose, double time) const;  ///< of the wall after `time` (s) without forces
  Vector3 spin(const Eigen::Quaterniond& rotation) const;  ///< rad/s, of a wall with this rotation and the present momentum

  const FlightState& state() const { return state_; }
  void restore(const FlightState& state) { state_ = state; }

 private:
  const Flight& flight_;
  double step_;
  bool is_of_stepper_;
  Eigen::Matrix3d inverse_inertia_;
  dBodyID body_;
  FlightState state_;
  bool is_held_ = true;
};

}  // namespace falling_particles
