// The body of a driven wall in an ODE world.
#pragma once

#include <ode/ode.h>

#include "model/wall.hpp"

namespace falling_particles {

/// The state of a driven wall between two steps.
struct DrivenState {
  double position = 0;  ///< m along the axis, or rad about it
  double speed = 0;     ///< m/s or rad/s
  double push = 0;      ///< N or N m, of the drive in the last step
  double load = 0;      ///< N, of the grains against the axis in the last step, on a servo

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(position, speed, push, load);
  }
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

}  // namespace falling_particles
