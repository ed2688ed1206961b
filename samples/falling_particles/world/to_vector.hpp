// Vectors of ODE, and rotations by vectors.
#pragma once

#include <ode/ode.h>

#include "common/motion.hpp"

namespace falling_particles {

using namespace common;

inline Vector3 to_vector(const dReal* v) { return {v[0], v[1], v[2]}; }

/// `vector`: rad, along the axis.
inline Eigen::Quaterniond rotation_by(const Vector3& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle)) : Eigen::Quaterniond::Identity();
}

/// Grain::move of a body that the stepper moves; null for quickstep.
inline WallVelocity* move_by_stepper(dBodyID body) { return static_cast<WallVelocity*>(dBodyGetData(body)); }

/// m/s, the velocity with which a body was moved in the last step. By quickstep it is the new velocity before [damping], which ODE
/// applies after the move. 0 if damping has taken all of it.
inline Vector3 velocity_of_move(dBodyID body) {
  if (const auto* const move = move_by_stepper(body)) return move->linear;
  const double kept = 1 - dBodyGetLinearDamping(body);
  return kept > 0 ? Vector3(to_vector(dBodyGetLinearVel(body)) / kept) : Vector3(Vector3::Zero());
}

/// m, of a body before the last step (s).
inline Vector3 position_before(dBodyID body, double step) {
  return to_vector(dBodyGetPosition(body)) - step * velocity_of_move(body);
}

/// rad/s, as velocity_of_move() of the angular velocity.
inline Vector3 spin_of_move(dBodyID body) {
  if (const auto* const move = move_by_stepper(body)) return move->angular;
  const double kept = 1 - dBodyGetAngularDamping(body);
  return kept > 0 ? Vector3(to_vector(dBodyGetAngularVel(body)) / kept) : Vector3(Vector3::Zero());
}

}  // namespace falling_particles
