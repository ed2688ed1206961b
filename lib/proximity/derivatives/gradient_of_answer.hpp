// The gradient of the gap from the points of an answer alone.
#pragma once

#include <Eigen/Geometry>

#include "supernormal/proximity/derivatives.hpp"

namespace supernormal {

/// (-n, -P1 x n, n, P2 x n) with the witness points relative to the origins of their bodies' frames.
inline TwistVector gradient_of(const Vector3& n, const Vector3& p1, const Vector3& p2) {
  TwistVector gradient;
  gradient << -n, n.cross(p1), n, p2.cross(n);
  return gradient;
}

/// For bodies that cannot be evaluated at a normal nearby: without a Hessian, or a mesh. It is as exact as the answer's normal and
/// points, and evaluates nothing. The points are any points of flat faces. On the line between them, the point beside the contact
/// is opposite the other body's point.
inline TwistVector gradient_of_answer(const Pose& pose1, const Pose& pose2, const Proximity& proximity) {
  const Vector3& n = proximity.normal;
  Vector3 point = proximity.point1;
  const Vector3 between = proximity.point2 - proximity.point1;
  const Vector3 across = between - between.dot(n) * n;
  const double squared = across.squaredNorm();
  const double along = across.dot(proximity.contact - proximity.point1);
  if (along > 0) point += (along < squared ? along / squared : 1) * across;
  return gradient_of(n, point - pose1.position, point - pose2.position);
}

}  // namespace supernormal
