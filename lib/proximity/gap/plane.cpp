#include "supernormal/proximity/plane.hpp"

#include <cmath>

#include "base/usable_pose.hpp"
#include "base/validation.hpp"

namespace supernormal {

Proximity find_plane_proximity(const Shape& shape, const Pose& pose, const Vector3& plane_normal, double plane_offset) {
  require_unit("plane_normal", plane_normal);
  if (!is_usable(pose) || !all_finite(plane_normal) || !std::isfinite(plane_offset)) return {};
  Jet jet;
  shape.evaluate(-(pose.rotation.transpose() * plane_normal), Order::Point, jet);
  Proximity result;
  result.gap = plane_normal.dot(pose.position) - plane_offset - jet.h;
  result.normal = -plane_normal;
  result.point1 = pose.position + pose.rotation * jet.r;
  result.point2 = result.point1 - result.gap * plane_normal;
  result.contact = result.point1;
  const bool finite = std::isfinite(result.gap) && all_finite(result.point1);
  result.status = finite ? Status::Converged : Status::InvalidInput;
  result.is_global = finite;
  if (finite) result.global_error = 0;
  return result;
}

}  // namespace supernormal
