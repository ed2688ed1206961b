// Method 4: the boundary of the Minkowski difference in closed form, and Wellmann's angles of the common normal.
#pragma once

#include "method.hpp"

namespace literature {

// Ruan, Wang and Chirikjian (2022) describe the boundary of the Minkowski difference by the gradient of body 1. It is the sum of
// body 1 and the mirrored body 2. They search its point nearest to the centre of body 2. They start at the angles of this centre.

/// Fixed-point iteration: the next normal points from a centre of curvature, known from the last two points, to the centre of body
/// 2.
CommonNormal contact_space_fixed_point(const Bodies& bodies, const Options& options);

/// Least squares (Levenberg, Marquardt) of the distance from the boundary to the centre of body 2, in the angles of the gradient.
CommonNormal contact_space_distance(const Bodies& bodies, const Options& options);

/// Least squares of the cross product of the normal and the vector from the boundary to the centre of body 2. The two are parallel
/// at the solution.
CommonNormal contact_space_common_normal(const Bodies& bodies, const Options& options);

/// Wellmann, Lillie and Wriggers (2008): the distance of the points with one normal as a function of its two polar angles, by
/// Newton's method with the damping of Levenberg and Marquardt.
CommonNormal normal_angles(const Bodies& bodies, const Options& options);

}  // namespace literature
