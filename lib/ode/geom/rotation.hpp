// Rotations of geoms, made orthonormal to rounding for the core.
#pragma once

#include <ode/ode.h>

#include <cmath>

#include "base/usable_pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// Rotations that ODE computes in double precision, from a quaternion, Euler angles, or an axis and an angle, are within this
/// error. They are used unchanged. Flat faces tolerate no more: beyond 4e-15 the normal of a cylinder's cap does not survive a
/// round trip. With an exponent of 60, queries already suffer from 1e-11.
inline constexpr double kRoundedRotation = 1e-14;

/// Whether a matrix is a rotation to rounding.
inline bool is_orthonormal(const Matrix3& R) { return std::islessequal(rotation_error(R), kRoundedRotation); }

/// The rotation nearest to the matrix of a geom that is not a rotation to rounding. The core would otherwise compare numbers known
/// to 1e-7 with a tolerance of 1e-9. In single precision every rotation is that inaccurate. Throws std::invalid_argument if the
/// matrix is far from any rotation. Returns a matrix that is not finite unchanged: the core refuses it.
Matrix3 nearest_rotation(const Matrix3& R, dGeomID geom);

/// The rotation as the core requires it.
inline Matrix3 orthonormal(const Matrix3& R, dGeomID geom) { return is_orthonormal(R) ? R : nearest_rotation(R, geom); }

}  // namespace supernormal::ode
