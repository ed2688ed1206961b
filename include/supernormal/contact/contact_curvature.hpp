// The curvature of two bodies at their contact.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The curvature tensor (shape operator) K of the boundary at the point with the outward unit normal n, 1/m. n and K are in the
/// world frame. K is symmetric, and K n = 0. K maps a tangential displacement of the boundary point to the change of its normal. It
/// is the inverse of the Hessian H, whose eigenvalues are the radii of curvature. It is 0 on a flat face, and at most 1e9 over the
/// smallest half-extent on an edge. If the shape delivers no H, K comes from finite differences of boundary points.
SUPERNORMAL_API Matrix3 find_curvature(const Shape& shape, const Pose& pose, const Vector3& n);

/// Principal values of the relative curvature K1 + K2, 1/m. The gap between the bodies grows as (smaller x^2 + larger y^2) / 2.
struct ContactCurvature {
  double smaller = 0;  ///< 1/m; along the direction in which the bodies separate most slowly
  double larger = 0;   ///< 1/m; across this direction
};

/// The principal values of `sum` = K1 + K2 (1/m), the curvature tensors of the two bodies at a contact with the unit normal n.
SUPERNORMAL_API ContactCurvature find_contact_curvature(const Matrix3& sum, const Vector3& n);

}  // namespace supernormal
