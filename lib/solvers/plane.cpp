#include "supernormal/solvers/plane.hpp"

#include <cmath>

namespace supernormal {

Proximity find_plane_proximity(const Shape& shape, const Pose& pose, const Vector3& plane_normal, double plane_offset) {
  Jet jet;
  shape.evaluate(-(pose.rotation.transpose() * plane_normal), Order::Point, jet);
  Proximity result;
  result.gap = plane_normal.dot(pose.position) - plane_offset - jet.h;
  result.normal = -plane_normal;
  result.point1 = pose.position + pose.rotation * jet.r;
  result.point2 = result.point1 - result.gap * plane_normal;
  result.contact = result.point1;
  const bool finite = std::isfinite(result.gap) && plane_normal.allFinite() && result.point1.allFinite();
  result.status = finite ? Status::Converged : Status::InvalidInput;
  return result;
}

}  // namespace supernormal
