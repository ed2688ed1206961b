// The curvature of two bodies at their contact.
#pragma once

#include <span>

#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/relative_curvature.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The curvature tensor (shape operator) K of the boundary at the point with the outward unit normal n, 1/m. n and K are in the
/// world frame. K is symmetric, and K n = 0. K maps a tangential displacement of the boundary point to the change of its normal. It
/// is the inverse of the Hessian H, whose eigenvalues are the radii of curvature. It is 0 on a flat face, and at most 1e9 over the
/// smallest half-extent on an edge. If the shape delivers no H, K comes from finite differences of boundary points.
SUPERNORMAL_API Matrix3 find_curvature(const Shape& shape, const Pose& pose, const Vector3& n);

/// The principal values of `sum` = K1 + K2 (1/m), the curvature tensors of the two bodies at a contact with the unit normal n.
SUPERNORMAL_API ContactCurvature find_contact_curvature(const Matrix3& sum, const Vector3& n);

/// find_proximities(), and the curvature of each overlap: curvatures[k] is find_contact_curvature() of the sum of both bodies'
/// find_curvature() at results[k].normal, to rounding. It is 0 where the gap is not negative, and where the input is invalid.
/// Where vector lanes have solved a pair, the query has already evaluated the Hessians, and the curvature is nearly free.
///
/// Throws std::invalid_argument as find_proximities() does, and if `curvatures` has another length than `queries`.
SUPERNORMAL_API void find_proximities(std::span<const ProximityQuery> queries, const Settings& settings,
                                      std::span<Proximity> results, std::span<ContactCurvature> curvatures);

}  // namespace supernormal
