// How sharply two bodies curve away from each other where they touch.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The curvature tensor (shape operator) of the boundary at the point with outward unit normal n (world frame), 1/m: the
/// symmetric matrix that takes a tangential step to the change of the normal, K n = 0. It is the inverse of the Hessian H, which
/// holds the radii of curvature: 0 on a flat face, and on an edge no more than 1e9 over the smallest half-extent. Where the shape
/// delivers no H, it is found from finite differences of boundary points.
SUPERNORMAL_API Matrix3 find_curvature(const Shape& shape, const Pose& pose, const Vector3& n);

/// Principal values of the relative curvature K1 + K2, 1/m: the gap between the bodies grows as (smaller x^2 + larger y^2) / 2.
struct ContactCurvature {
  double smaller = 0;  ///< along the direction in which the bodies part most slowly
  double larger = 0;   ///< across it
};

/// Returns the principal values of `sum` = K1 + K2, the curvatures of the two bodies at a contact with the unit normal n.
SUPERNORMAL_API ContactCurvature find_contact_curvature(const Matrix3& sum, const Vector3& n);

}  // namespace supernormal
