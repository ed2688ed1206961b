// Conversions between the types of ODE and of the core. dReal may be float; the core uses double.
#pragma once

#include <ode/ode.h>

#include <limits>

#include "base/finite.hpp"
#include "base/usable_pose.hpp"
#include "ode/geom/rotation.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// Relative to a coordinate: what a float may lose.
inline constexpr double kFloatRounding = 0.5 * std::numeric_limits<float>::epsilon();

inline dReal to_real(double value) { return static_cast<dReal>(value); }

inline Vector3 to_vector(const dReal* v) { return Vector3(v[0], v[1], v[2]); }

/// Writes three coordinates. The fourth one of a dVector3 is left unchanged.
inline void from_vector(const Vector3& v, dReal* out) {
  for (int i = 0; i < 3; ++i) out[i] = to_real(v[i]);
}

/// Reads a row-major matrix with rows of four, the layout of rotations in ODE. Does not correct it.
inline Matrix3 to_rotation(const dReal* R) {
  Matrix3 rotation;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation(row, column) = R[4 * row + column];
  }
  return rotation;
}

/// The rotation of a placeable geom, orthonormal to rounding (see rotation.hpp).
inline Matrix3 rotation_of(dGeomID geom) { return orthonormal(to_rotation(dGeomGetRotation(geom)), geom); }

/// A pose, and whether the core may take it without a test of its own (ProximityQuery::poses_are_usable).
struct TestedPose {
  Pose pose;
  bool is_usable;
};

/// The pose of these numbers of ODE. Messages name the geom.
inline TestedPose tested_pose(const dReal* position, const dReal* R, dGeomID geom) {
  TestedPose out{{to_vector(position), to_rotation(R)}, false};
  const bool is_rotation = is_orthonormal(out.pose.rotation);
  if (!is_rotation) out.pose.rotation = nearest_rotation(out.pose.rotation, geom);  // rare; otherwise no copy
  out.is_usable = is_rotation && all_within(out.pose.position, kFarthest);
  return out;
}

/// The current pose of a placeable geom. Do not cache it: inside a dGeomTransform ODE replaces the pose during a call.
inline TestedPose tested_pose_of(dGeomID geom) { return tested_pose(dGeomGetPosition(geom), dGeomGetRotation(geom), geom); }
inline Pose pose_of(dGeomID geom) { return tested_pose_of(geom).pose; }

}  // namespace supernormal::ode
