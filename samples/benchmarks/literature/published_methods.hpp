// The published methods, with their numbers in README.md.
#pragma once

#include "start.hpp"

namespace literature {

// Method 1: the common normal of two implicit functions.

/// Newton's method for the six coordinates of two points. Both are on their surfaces. The normal of body 1 and the line between the
/// points are perpendicular to both tangents of body 2 (Lopes, Silva, Ambrosio, Flores 2010; Goncalves, Bernardino, Jorge, Lopes
/// 2017). The Jacobian is analytic, as in the first of the two papers.
CommonNormal common_normal_points(const Bodies& bodies, const Options& options, Start start);

// Method 2: the common normal in the angles of both surfaces.

/// Newton's method for the latitude and longitude of both points, with an analytic Jacobian. The normal of body 1 and the line
/// between the points are perpendicular to both tangents of body 2 (the parametric form of Goncalves et al. 2017).
CommonNormal common_normal_angles(const Bodies& bodies, const Options& options, Start start);

// Method 3: the midway point of discrete element codes.

/// The point with F1 = F2 and opposite gradients (Houlsby 2009), by Newton's method for its coordinates and a multiplier, with a
/// line search. The first bodies are spheres, whose solution is known. Radii and exponents change to the real ones in at least ten
/// stages (Podlozhnyuk, Pirker, Kloss 2017). The bodies overlap if the point is inside both. The depth is then the distance of the
/// surfaces along the common gradient through the point. It is not the shortest distance, so the result differs from the gap by
/// definition.
CommonNormal midway_point(const Bodies& bodies, const Options& options);

// Method 4: the boundary of the Minkowski difference in closed form, and Wellmann's angles of the common normal.
//
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
