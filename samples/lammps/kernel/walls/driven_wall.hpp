// A wall that forces move along an axis, or about it, and the time of its run.
#pragma once

#include "common/drive.hpp"
#include "common/motion.hpp"
#include "kernel/body.hpp"

namespace granular {

/// The time (s) of a run with steps of any length. The step counter of LAMMPS is no measure of time: it may be reset, and the step
/// may change at any moment. While the step is constant, the time is an exact product.
class Clock {
 public:
  struct State {
    double before = 0;  ///< s; time before the first step of the present length
    double steps = 0;   ///< steps of the present length so far; an integer
    double step = 0;    ///< s
  };

  Clock() = default;
  explicit Clock(const State& state) : state_(state) {}

  double now() const { return state_.before + state_.steps * state_.step; }
  const State& state() const { return state_; }

  /// Adds one step (s).
  void advance(double step) {
    if (step != state_.step) state_ = {now(), 0, step};
    ++state_.steps;
  }

 private:
  State state_;
};

/// The degree of freedom of a driven wall, with the laws of a [[part]] of falling_particles. It is integrated like the particles,
/// by velocity Verlet: kick(), drift(), forces of the contacts, kick(). Damping is implicit. A servo has no mass: each first kick()
/// sets its speed, from the contacts of the step before.
///
/// Poses and velocities are relative to the carrier: the wall with its prescribed motions alone.
class DrivenWall {
 public:
  /// What a restart file stores.
  struct State {
    double position = 0;  ///< m along the axis, or rad about it
    double speed = 0;     ///< m/s or rad/s
    double load = 0;      ///< N along the axis, or N m about it, of the contacts in the last step
    double push = 0;      ///< N or N m, of the drive in the last step
  };

  /// `start`: the pose of the wall before it moves.
  DrivenWall(common::Drive drive, const common::WallPose& start);

  /// Takes half a step: the speed from the load, the drive and gravity (m/s^2). `now`: s, the middle of this half; `step`: s, the
  /// whole.
  void kick(const common::WallPose& carrier, const Vector3& gravity, double now, double step);
  /// Moves the wall by a step (s). It stops at the ends of its travel.
  void drift(double step);
  /// Takes the force (N) of the contacts on the wall, and their torque (N m) about the wall's position.
  void load(const common::WallPose& carrier, const Vector3& force, const Vector3& torque);

  /// Of a servo, m^2.
  void set_area(double area) { drive_.servo->area = area; }

  common::WallPose pose_on(const common::WallPose& carrier) const;
  common::WallVelocity velocity_on(const common::WallPose& carrier, const common::WallVelocity& velocity) const;

  double stress() const { return drive_.servo ? -state_.load / drive_.servo->area : 0; }  ///< Pa, of the contacts on a servo
  const State& state() const { return state_; }
  void restore(const State& state) { state_ = state; }

 private:
  void stop();

  common::Drive drive_;
  common::DrivenAxis axis_;
  State state_;
};

}  // namespace granular
