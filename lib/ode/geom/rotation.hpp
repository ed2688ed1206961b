// Rotations of geoms, made orthonormal to rounding as the core requires.
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <cmath>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// Rotations that ODE computes in double precision from quaternions, Euler angles or an axis and an angle are within this error,
/// and are used unchanged. Flat faces are sensitive to more: beyond 4e-15 the normal of a cylinder's cap no longer comes back as
/// one, and queries of bodies as flat as with an exponent of 60 suffer from 1e-11.
inline constexpr double kRoundedRotation = 1e-14;

/// The sum of the errors of the equations that make a matrix a rotation: the first two columns are unit vectors at right angles,
/// and the third is their cross product. NaN if an entry is not a number.
inline double rotation_error(const Matrix3& R) {
  // The entries are read one by one: they have just been written one by one, and a load of two of them would wait for the stores.
  const double x0 = R(0, 0), x1 = R(1, 0), x2 = R(2, 0);
  const double y0 = R(0, 1), y1 = R(1, 1), y2 = R(2, 1);
  const double z0 = R(0, 2), z1 = R(1, 2), z2 = R(2, 2);
  const double x_length = std::abs(x0 * x0 + x1 * x1 + x2 * x2 - 1);
  const double y_length = std::abs(y0 * y0 + y1 * y1 + y2 * y2 - 1);
  const double angle = std::abs(x0 * y0 + x1 * y1 + x2 * y2);
  const double skew0 = std::abs(x1 * y2 - x2 * y1 - z0);
  const double skew1 = std::abs(x2 * y0 - x0 * y2 - z1);
  const double skew2 = std::abs(x0 * y1 - x1 * y0 - z2);
  return (x_length + y_length) + (angle + skew0) + (skew1 + skew2);
}

inline bool is_orthonormal(const Matrix3& R) { return std::islessequal(rotation_error(R), kRoundedRotation); }

/// The rotation nearest to that of a geom that is not one to rounding: the core would otherwise compare numbers known to 1e-7
/// with a tolerance of 1e-9, and with single precision every rotation is as rough as that. Throws std::invalid_argument if the
/// matrix is far from any rotation. A matrix that is not finite is left for the core to refuse.
Matrix3 nearest_rotation(const Matrix3& R, dGeomID geom);

/// The rotation as the core requires it.
inline Matrix3 orthonormal(const Matrix3& R, dGeomID geom) { return is_orthonormal(R) ? R : nearest_rotation(R, geom); }

}  // namespace supernormal::ode
