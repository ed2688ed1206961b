#include "proximity/search/certified_newton.hpp"

#include <algorithm>
#include <cmath>

#include "proximity/bounds/minimum_norm_point.hpp"
#include "proximity/gap/tuning.hpp"
#include "proximity/search/answer.hpp"

namespace supernormal {

CertifiedNewton::CertifiedNewton(GapFunction& gap, CuttingPlanes& cuts, const StoppingRule& rule)
    : gap_(gap),
      cuts_(cuts),
      rule_(rule),
      rolling_radius_(gap.rolling_radius()),
      has_flat_faces_(gap.traits1().has_flat_faces || gap.traits2().has_flat_faces) {}

CertifiedNewton::End CertifiedNewton::run(const Vector3& start, WantedMaximum wanted) {
  const bool is_finite = evaluate(start);
  best_ = 1 - best_;
  if (!is_finite || (wanted == WantedMaximum::Tracked && !is_provable())) return End::Open;
  while (true) {
    if (rule_.is_apart(best())) return End::Apart;
    if (is_proved()) return End::Proved;
    Vector3 step;
    if (propose(step) && climb(step)) continue;
    return has_flat_faces_ && prove_by_tilts() ? End::Proved : End::Open;
  }
}

bool CertifiedNewton::is_proved() {
  error_ = optimality_gap_bound(best(), rolling_radius_);
  return is_provable() && rule_.allows(error_);
}

bool CertifiedNewton::evaluate(const Vector3& n, Order order) {
  gap_.evaluate(n, order, next());
  cuts_.add(next().d + rolling_radius_ * next().n);
  return next().is_finite();
}

bool CertifiedNewton::propose(Vector3& step) const {
  const GapJet& jet = best();
  const Matrix3 H2 = gap_.rotation() * jet.jet2.H * gap_.rotation().transpose();
  const RegularHessian hessian(jet.jet1.H + H2, jet.s, jet.n, gap_.length_unit(), limits::kFlattest);
  if (!hessian.is_regular()) return false;
  step = hessian.solve(jet.d - jet.s * jet.n);
  if (has_flat_faces_ && !parametrizations_agree(step) && !through_boundary_points(hessian, H2, step)) return false;
  // Deeper than the ball nothing can be proved. If the step gains nothing either, other methods take over.
  if (!is_provable() && !(jet.d.dot(step) > rule_.tolerance())) return false;
  const double squared = step.squaredNorm();
  if (squared > kTuning.longest_step * kTuning.longest_step) step *= kTuning.longest_step / std::sqrt(squared);
  return true;
}

// If the flat faces are across the body's axes, the boundary point is a function of the ratios of the normal's components. If the
// ratios hardly change, both steps are the same.
bool CertifiedNewton::parametrizations_agree(const Vector3& step) const {
  const auto is_less = [](const Vector3& tilt, const Vector3& normal) {
    return (tilt.array().abs() <= kTuning.same_tilt * normal.array().abs()).all();
  };
  return is_less(step, best().n) && is_less(gap_.rotation().transpose() * step, best().m);
}

// On a flat face the normal is a smooth function of the boundary point, but not the other way round. So each body returns the
// normal at the point that the step leads to. Newton's equation is then solved with these tilts.
bool CertifiedNewton::through_boundary_points(const RegularHessian& hessian, const Matrix3& H2, Vector3& step) const {
  const GapJet& jet = best();
  const auto tilt_beyond_step = [&](const Vector3& normal, Vector3& tilt) {
    const double height = normal.dot(jet.n);
    if (!(height > limits::kGrazing * normal.norm())) return false;
    tilt = normal / height - jet.n - step;
    return true;
  };
  Vector3 pull = Vector3::Zero(), tilt;
  if (gap_.traits1().has_flat_faces) {
    if (!tilt_beyond_step(gap_.shape1().advance_normal(jet.n, jet.jet1, step), tilt)) return false;
    pull = jet.jet1.H * tilt;
  }
  if (gap_.traits2().has_flat_faces) {
    const Vector3 normal = gap_.shape2().advance_normal(jet.m, jet.jet2, -(gap_.rotation().transpose() * step));
    if (!tilt_beyond_step(-(gap_.rotation() * normal), tilt)) return false;
    pull += H2 * tilt;
  }
  const Vector3 through_points = step + hessian.solve(pull);
  if (jet.d.dot(through_points) > 0) step = through_points;
  return true;
}

bool CertifiedNewton::climb(Vector3 step) {
  const StoppingRule rule = rule_.with_at_most(kTuning.newton_evaluations);
  while (rule.may_evaluate()) {
    if (!evaluate((best().n + step).normalized())) return false;
    if (next().s > best().s) {
      best_ = 1 - best_;
      return true;
    }
    // A face is level: no shorter step leads higher.
    if (has_flat_faces_ && next().s >= best().s - gap_.rounding()) return false;
    step *= 0.5;
  }
  return false;
}

// On a flat face the boundary point crosses the face within a tilt below rounding. So d(n) does not come near the line along n. But
// the tilt can be so small that s does not change by the tolerance, and the boundary point is on the other side of this line. Hulls
// of few such points meet the line.
bool CertifiedNewton::prove_by_tilts() {
  if (!is_provable()) return false;
  const Vector3 n = best().n;
  const double height = best().s + rolling_radius_;
  const StoppingRule rule = rule_.with_at_most(gap_.evaluations() + limits::kMostTilts);
  const Matrix3 curvature = gap_.curvature(best());
  double growth = 1;
  while (true) {
    const MinimumNormPoint nearest = minimum_norm_point(cuts_.points());
    error_ = std::max(nearest.norm - height, 0.0);
    if (rule.allows(error_)) return true;
    if (!rule.may_evaluate()) return false;
    const Vector3 beside = nearest.point - nearest.point.dot(n) * n;
    const double distance = beside.norm();
    if (!(distance > 0)) return false;
    // The point of the best normal is as far on the other side at this tilt, by its radius of curvature. On a flat face no digit of
    // the radius need be right, and the least tilt crosses it.
    const double before = best().d.dot(beside) / distance, radius = beside.dot(curvature * beside) / (distance * distance);
    const double crossing = before > 0 && radius > 0 ? 2 * before / radius : 0;
    const double least_tilt = rule.tolerance() / std::max(distance, gap_.length_unit());
    const double tilt = std::min(std::max(growth * least_tilt, crossing), rule.tolerance() / distance);
    if (!evaluate((n + tilt / distance * beside).normalized(), Order::Point)) return false;
    beside_[beside_count_++] = {next().n, next().jet1.r, next().d};
    // If the radius was too large, the point has only moved a part of the way.
    const double reached = next().d.dot(beside) / distance;
    growth = reached > 0 && reached < before ? 2 * tilt / least_tilt * before / (before - reached) : 1;
  }
}

}  // namespace supernormal
