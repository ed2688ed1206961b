// What the methods of the literature have in common.
#pragma once

#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "superquadric.hpp"

namespace literature {

/// Two superellipsoids in the frame of the first.
struct Bodies {
  Superquadric body1, body2;
  const supernormal::Shape *shape1, *shape2;  ///< the same bodies
  Matrix3 rotation;                           ///< the orientation of body 2
  Vector3 offset;                             ///< m; the centre of body 2

  /// Keeps pointers to the shapes. Throws std::invalid_argument if one is neither a superellipsoid nor an ellipsoid.
  Bodies(const supernormal::Shape& first, const supernormal::Pose& pose1, const supernormal::Shape& second,
         const supernormal::Pose& pose2);

  double size() const;  ///< m; the smallest half-axis

  Vector3 in_body2(const Vector3& point) const { return rotation.transpose() * (point - offset); }
};

struct Options {
  double tolerance = 1e-9;  ///< of the last step: rad, or m over the smallest half-axis
  int max_iterations = 30;  ///< Goncalves et al. 2017
  /// Where to start: the normal of an earlier, similar pose (unit, body 1's frame), or null for the method's own start.
  const Vector3* first_normal = nullptr;
  std::vector<Vector3>* path = nullptr;  ///< if it is given, the normal of every iterate is added to it (body 1's frame)
};

enum class Outcome {
  Failed,  ///< not converged, or to a stationary point that cannot be the gap
  Apart,   ///< the bodies do not overlap; the method does not know their distance
  Found,   ///< the gap is known
};

/// A common normal, in body 1's frame.
struct CommonNormal {
  Outcome outcome = Outcome::Failed;
  double gap = 0;                     ///< m; negative for overlapping bodies
  Vector3 normal = Vector3::UnitX();  ///< unit, from body 1 to body 2
  Vector3 point1 = Vector3::Zero();   ///< m; on body 1
  Vector3 point2 = Vector3::Zero();   ///< m; on body 2
  int evaluations = 0;                ///< of both bodies; the start included
};

using Solve = CommonNormal (*)(const Bodies& bodies, const Options& options);

/// A method by its name.
struct NamedMethod {
  const char* name;
  Solve solve;
};

/// All methods of this folder, with their numbers in README.md.
const std::vector<NamedMethod>& methods();

/// Judges two points with opposite normals as Goncalves et al. do: the normals must point at each other, and away if body 1 has
/// point 2 inside. Otherwise the points belong to another kind of stationary point. A gap that is smaller than `accuracy` (m) has
/// no sure sign.
CommonNormal judged(const Bodies& bodies, const Vector3& point1, const Vector3& normal1, const Vector3& point2,
                    const Vector3& normal2, double accuracy, int evaluations);

}  // namespace literature
