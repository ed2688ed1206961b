// Rotations of geoms, made orthonormal to rounding as the core requires.
#pragma once

#include <ode/ode.h>

#include <cmath>

#include "proximity/usable_pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// Rotations that ODE computes in double precision from quaternions, Euler angles or an axis and an angle are within this error,
/// and are used unchanged. Flat faces are sensitive to more: beyond 4e-15 the normal of a cylinder's cap no longer comes back as
/// one, and queries of bodies as flat as with an exponent of 60 suffer from 1e-11.
inline constexpr double kRoundedRotation = 1e-14;

/// Whether a matrix is a rotation to rounding.
inline bool is_orthonormal(const Matrix3& R) { return std::islessequal(rotation_error(R), kRoundedRotation); }

/// The rotation nearest to that of a geom that is not one to rounding: the core would otherwise compare numbers known to 1e-7
/// with a tolerance of 1e-9, and with single precision every rotation is as rough as that. Throws std::invalid_argument if the
/// matrix is far from any rotation. A matrix that is not finite is left for the core to refuse.
Matrix3 nearest_rotation(const Matrix3& R, dGeomID geom);

/// The rotation as the core requires it.
inline Matrix3 orthonormal(const Matrix3& R, dGeomID geom) { return is_orthonormal(R) ? R : nearest_rotation(R, geom); }

}  // namespace supernormal::ode
