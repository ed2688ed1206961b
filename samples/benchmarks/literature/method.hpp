// Common types of the literature methods.
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

}  // namespace literature
