// Motion of bodies at the start of a step. `body` = 0 is a wall at rest.
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>

#include "ode/geom/convert.hpp"
#include "ode/geom/look_ahead.hpp"

namespace supernormal::ode {

/// m/s^2; the acceleration known before the step, from gravity and the forces so far.
inline Vector3 acceleration_of(dBodyID body) {
  if (body == nullptr || dBodyIsKinematic(body) != 0) return Vector3::Zero();
  dMass mass;
  dBodyGetMass(body, &mass);
  return acceleration_of(body, mass);
}

/// m/s
inline Vector3 velocity_at(dBodyID body, const Vector3& point) {
  if (body == nullptr) return Vector3::Zero();
  const Vector3 lever = point - to_vector(dBodyGetPosition(body));
  return to_vector(dBodyGetLinearVel(body)) + to_vector(dBodyGetAngularVel(body)).cross(lever);
}

}  // namespace supernormal::ode
