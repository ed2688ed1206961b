// Conversions between ODE's types and the core's: dReal may be float, the core is double throughout.
#pragma once

#include <ode/ode.h>

#include "ode/geom/rotation.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

inline dReal to_real(double value) { return static_cast<dReal>(value); }

inline Vector3 to_vector(const dReal* v) { return Vector3(v[0], v[1], v[2]); }

/// Writes the three coordinates; a fourth one (dVector3 has it) is left alone.
inline void from_vector(const Vector3& v, dReal* out) {
  for (int i = 0; i < 3; ++i) out[i] = to_real(v[i]);
}

/// Reads a row-major matrix with rows of four, as ODE keeps rotations, without correcting it.
inline Matrix3 to_rotation(const dReal* R) {
  Matrix3 rotation;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation(row, column) = R[4 * row + column];
  }
  return rotation;
}

/// The rotation of a placeable geom, orthonormal to rounding (rotation.hpp).
inline Matrix3 rotation_of(dGeomID geom) { return orthonormal(to_rotation(dGeomGetRotation(geom)), geom); }

/// The current pose of a placeable geom. It is read anew in every call: inside a dGeomTransform ODE swaps the pose for the time
/// of the call.
inline Pose pose_of(dGeomID geom) {
  Pose pose{to_vector(dGeomGetPosition(geom)), to_rotation(dGeomGetRotation(geom))};
  if (!is_orthonormal(pose.rotation)) pose.rotation = nearest_rotation(pose.rotation, geom);  // rare; otherwise nothing is copied
  return pose;
}

}  // namespace supernormal::ode
