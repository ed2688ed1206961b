#include "proximity/search/answer.hpp"

#include <algorithm>
#include <limits>

#include "proximity/gap/limits.hpp"

namespace supernormal {

double optimality_gap_bound(const GapJet& jet, double rolling_radius) {
  // Rounding of d may make this negative, because a large body's boundary point is rotated.
  return std::max((jet.d + rolling_radius * jet.n).norm() - (jet.s + rolling_radius), 0.0);
}

Proximity answer(const GapFunction& gap, const StoppingRule& rule, const GapJet& jet, double model_error, Status status) {
  Proximity out;
  out.gap = jet.s;
  out.normal = jet.n;
  out.point1 = jet.jet1.r;
  out.point2 = jet.jet1.r + jet.d;
  out.contact = 0.5 * (out.point1 + out.point2);
  out.evaluations = gap.evaluations();
  out.status = status;
  if (status == Status::Apart || status == Status::Diverged) model_error = std::numeric_limits<double>::infinity();
  const double tolerance = rule.tolerance();
  // s + rho is the gap function of the bodies without the balls that roll inside them. If it is positive, those bodies are apart,
  // and it is concave on the cone of the separating normals. If touching bodies have a stationary point with s = -x, the largest
  // gap is at most x, because s extended to all vectors is concave.
  const bool is_concave = jet.s + gap.rolling_radius() > 0;
  const bool is_touching = 2 * jet.s >= -tolerance;
  out.is_global = jet.s > 0 || (status != Status::Diverged && (is_concave || is_touching));
  // Where s need not be concave, the model proves nothing, however small its error. So the answer claims no more than the
  // tolerance.
  if (!is_concave) model_error = std::max(model_error, tolerance);
  const double excess = optimality_gap_bound(jet, gap.rolling_radius());
  out.error = std::min(model_error, excess) + gap.rounding();
  out.global_error = out.is_global ? std::max(out.error, tolerance + gap.rounding()) : excess + gap.rounding();
  return out;
}

Proximity in_world(Proximity out, const Pose& pose1) {
  out.normal = (pose1.rotation * out.normal).normalized();
  out.point1 = pose1.rotation * out.point1 + pose1.position;
  out.point2 = pose1.rotation * out.point2 + pose1.position;
  out.contact = pose1.rotation * out.contact + pose1.position;
  return out;
}

void place_contact(GapFunction& gap, const StoppingRule& rule, const GapJet& jet, Proximity& out,
                   std::span<const WitnessPair> beside) {
  if (out.status == Status::InvalidInput) return;
  const bool is_guess = out.status == Status::Apart || out.status == Status::Diverged;
  out.contact = contact_point(gap, jet, is_guess ? rule.with_at_most(0) : rule, beside);
  out.evaluations = gap.evaluations();
}

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
