// Motion of bodies, and forces on them, for the passes.
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>

#include "ode/geom/convert.hpp"
#include "ode/geom/motion.hpp"

namespace supernormal::effects {

using ode::acceleration_of;
using ode::velocity_at;

inline Vector3 spin_of(dBodyID body) {
  return body == nullptr ? Vector3(Vector3::Zero()) : ode::to_vector(dBodyGetAngularVel(body));
}

/// 1/kg; the change of velocity along n at `point` by a unit impulse along n there.
inline double mobility(dBodyID body, const Vector3& point, const Vector3& n) {
  if (body == nullptr || dBodyIsKinematic(body) != 0) return 0;
  dMass mass;
  dBodyGetMass(body, &mass);
  const Matrix3 rotation = ode::to_rotation(dBodyGetRotation(body));
  const Vector3 arm = rotation.transpose() * (point - ode::to_vector(dBodyGetPosition(body))).cross(n);
  const Matrix3 inertia = ode::to_rotation(mass.I);
  return 1 / double{mass.mass} + arm.dot(inertia.inverse() * arm);
}

/// Adds a force (N) at `point`, in the world frame. Does nothing for `body` = 0, a wall.
inline void add_force(dBodyID body, const Vector3& force, const Vector3& point) {
  if (body == nullptr) return;
  using ode::to_real;
  dBodyAddForceAtPos(body, to_real(force.x()), to_real(force.y()), to_real(force.z()), to_real(point.x()), to_real(point.y()),
                     to_real(point.z()));
}

}  // namespace supernormal::effects
