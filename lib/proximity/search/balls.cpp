#include "proximity/search/balls.hpp"

#include <algorithm>
#include <limits>

#include "proximity/gap/limits.hpp"

namespace supernormal {

Proximity find_between_balls(const ProximityQuery& pair, double radius1, double radius2, const Settings& settings) {
  const Pose &pose1 = *pair.pose1, &pose2 = *pair.pose2;
  const Vector3 offset = pose2.position - pose1.position;
  const double distance = offset.norm(), reach = radius1 + radius2;
  Proximity out;
  if (distance > limits::kConcentric * reach) {
    out.normal = offset / distance;
  } else if (pair.first_normal != nullptr) {
    out.normal = (pose1.rotation * *pair.first_normal).normalized();
  } else {
    out.normal = (radius1 <= radius2 ? pose1 : pose2).rotation.col(0).normalized();
  }
  out.gap = out.normal.dot(offset) - reach;
  const double rounding = limits::kRoundingUnits * std::numeric_limits<double>::epsilon() * (distance + reach);
  out.error = std::max(distance - reach - out.gap, 0.0) + rounding;
  out.global_error = out.error;
  out.point1 = pose1.position + radius1 * out.normal;
  out.point2 = pose2.position - radius2 * out.normal;
  out.contact = 0.5 * (out.point1 + out.point2);
  out.status = settings.stop_when_apart && out.gap > 0 ? Status::Apart : Status::Converged;
  out.is_global = true;
  return out;
}

}  // namespace supernormal
