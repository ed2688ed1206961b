// The published methods, with their numbers in README.md, and their common types.
#pragma once

#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "superquadric.hpp"

namespace literature {

/// Two superellipsoids in the frame of the first.
struct Bodies {
  Superquadric body1, body2;
  const supernormal::Shape *shape1, *shape2;  ///< the same bodies
  Matrix3 rotation;                           ///< orientation of body 2
  Vector3 offset;                             ///< m; centre of body 2

  /// Keeps pointers to the shapes. Throws std::invalid_argument unless both are superellipsoids or ellipsoids.
  Bodies(const supernormal::Shape& first, const supernormal::Pose& pose1, const supernormal::Shape& second,
         const supernormal::Pose& pose2);

  double size() const;  ///< m; the smallest half-axis

  Vector3 in_body2(const Vector3& point) const { return rotation.transpose() * (point - offset); }
};

struct Options {
  double tolerance = 1e-9;  ///< of the last step: rad, or m relative to the smallest half-axis
  int max_iterations = 30;  ///< Goncalves et al. 2017
  /// The start: the normal of a similar earlier pose (unit, body 1's frame), or null for the method's own start.
  const Vector3* first_normal = nullptr;
  std::vector<Vector3>* path = nullptr;  ///< if given, collects the normal of every iterate (body 1's frame)
};

enum class Outcome {
  Failed,  ///< not converged, or converged to a stationary point that cannot be the gap
  Apart,   ///< the bodies do not overlap; the method does not compute their distance
  Found,   ///< the gap is known
};

/// A common normal, in body 1's frame.
struct CommonNormal {
  Outcome outcome = Outcome::Failed;
  double gap = 0;                     ///< m; negative for overlapping bodies
  Vector3 normal = Vector3::UnitX();  ///< unit, from body 1 to body 2
  Vector3 point1 = Vector3::Zero();   ///< m; on body 1
  Vector3 point2 = Vector3::Zero();   ///< m; on body 2
  int evaluations = 0;                ///< of both bodies, including the start
};

using Solve = CommonNormal (*)(const Bodies& bodies, const Options& options);

/// A method and its name.
struct NamedMethod {
  const char* name;
  Solve solve;
};

/// All methods of this folder, with their numbers in README.md.
const std::vector<NamedMethod>& methods();

/// Judges two points with opposite normals like Goncalves et al. The normals must point at each other, or away from each other if
/// body 1 contains point 2. Otherwise the points belong to another kind of stationary point. The sign of a gap below `accuracy` (m)
/// is uncertain.
CommonNormal judged(const Bodies& bodies, const Vector3& point1, const Vector3& normal1, const Vector3& point2,
                    const Vector3& normal2, double accuracy, int evaluations);

// Method 1: the common normal of two implicit functions.

/// Newton's method for the six coordinates of two points. Both are on their surfaces. The normal of body 1 and the line between the
/// points are perpendicular to both tangents of body 2 (Lopes, Silva, Ambrosio, Flores 2010; Goncalves, Bernardino, Jorge, Lopes
/// 2017). The Jacobian is analytic, as in the first of the two papers.
CommonNormal common_normal_points(const Bodies& bodies, const Options& options);

// Method 2: the common normal in the angles of both surfaces.

/// Newton's method for the latitude and longitude of both points, with an analytic Jacobian. The normal of body 1 and the line
/// between the points are perpendicular to both tangents of body 2 (the parametric form of Goncalves et al. 2017).
CommonNormal common_normal_angles(const Bodies& bodies, const Options& options);

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
