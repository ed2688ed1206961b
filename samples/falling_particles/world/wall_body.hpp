// The bodies of walls in an ODE world.
#pragma once

#include <ode/ode.h>

#include "common/motion.hpp"

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

}  // namespace falling_particles
