// The body of a free wall in an ODE world.
#pragma once

#include <ode/ode.h>

#include "model/wall.hpp"

namespace falling_particles {

/// The state of a free wall between two steps.
struct FlightState {
  Vector3 velocity = Vector3::Zero();  ///< m/s, of the centre of mass
  Vector3 momentum = Vector3::Zero();  ///< kg m^2/s, angular, about the centre of mass

  template <typename Archive>
  void serialize(Archive& archive) {
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
