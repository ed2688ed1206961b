#include "proximity/local/ascent.hpp"

#include <algorithm>
#include <cmath>

#include "proximity/answer.hpp"
#include "proximity/tuning.hpp"

namespace supernormal {
namespace {

// A trust radius below the spacing of double-precision directions contains no other normal.
constexpr double kNoRadius = 1e-15;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

Ascent::Ascent(GapFunction& gap, CuttingPlanes& cuts, const StoppingRule& rule, double unsearched_depth)
    : gap_(gap),
      cuts_(cuts),
      rule_(rule),
      unsearched_depth_(unsearched_depth),
      rolling_radius_(gap.rolling_radius()),
      has_kinks_(gap.traits2().has_nonsmooth_points),
      vertices_(gap),
      model_(gap, vertices_, cuts) {}

Status Ascent::climb(const Vector3& start, double cutoff) {
  restart();
  evaluate(start, now_);
  if (!gap_.has_hessian()) bfgs_.restart(current());
  return continue_climb(cutoff);
}

Status Ascent::climb(const GapJet& start) {
  restart();
  current() = start;
  return continue_climb(-kInfinity);
}

void Ascent::restart() {
  radius_ = kTuning.longest_step;
  upper_ = kInfinity;
  is_hull_next_ = false;
  is_model_short_ = false;
  is_stuck_ = false;
  is_from_bounds_ = false;
}

Status Ascent::continue_climb(double cutoff) {
  Status status = Status::Converged;
  while (true) {
    if (!current().is_finite()) return Status::InvalidInput;
    if (rule_.is_apart(current())) return Status::Apart;
    // If one bound proves the result, no model is needed. With colliders of known vertices this is nearly every warm query.
    error_ = optimality_gap_bound(current(), rolling_radius_);
    if (rule_.allows(error_) && !is_from_bounds_) return Status::Converged;
    const Step step = choose_step();
    if (is_finished(cutoff, status)) {
      if (has_kinks_ && is_from_bounds_) move_to_exact_normal();
      return status;
    }
    evaluate(step.normal.normalized(), 1 - now_);
    if (!gap_.has_hessian()) learn_hessian();
    const double actual_gain = trial().s - current().s;
    if (!is_from_hull_) adapt_radius(step, actual_gain);
    // Where s + rho is not concave, the hull's normal may be in another basin of attraction.
    if (actual_gain > 0 || is_level_but_flatter(actual_gain)) {
      if (is_from_hull_ && !is_concave()) radius_ = kTuning.longest_step;
      now_ = 1 - now_;
      is_from_bounds_ = step.remaining_gain == kInfinity;
    } else if (is_from_hull_ && trial().s > candidate_.s) {
      candidate_ = {trial().n, trial().s};
    }
  }
}

// Apart from rounding, a normal from the bounds is the normal of a face or an edge of body 2, and the boundary point is one of its
// vertices. The model's step goes to the exact normal. There any point between the vertices is a boundary point.
void Ascent::move_to_exact_normal() {
  const Step step = model_.propose(current(), active_[now_], bfgs_, kTuning.longest_step);
  if (model_.leaves_face() || !rule_.may_evaluate()) return;
  evaluate(step.normal.normalized(), 1 - now_);
  // If a bound has proved the present normal, it must prove the other one, too.
  const bool is_as_good = rule_.allows(error_) || rule_.allows(optimality_gap_bound(trial(), rolling_radius_));
  if (is_as_good && trial().s >= current().s - gap_.rounding()) now_ = 1 - now_;
}

bool Ascent::is_finished(double cutoff, Status& status) const {
  if (rule_.allows(error_) || rule_.allows(optimality_gap_bound(current(), rolling_radius_))) {
    status = Status::Converged;
  } else if (!rule_.may_evaluate()) {
    status = Status::EvaluationLimit;
  } else if (is_stuck_ || current().s + error_ < cutoff) {
    status = Status::Stalled;
  } else {
    return false;
  }
  return true;
}

Step Ascent::choose_step() {
  Step step = model_.propose(current(), active_[now_], bfgs_, radius_);
  const double estimate = model_.leaves_face() ? std::numeric_limits<double>::infinity() : step.remaining_gain;
  const bool is_done = rule_.allows(estimate);
  const bool must_replace = model_.leaves_face() || is_model_short_ || radius_ < kNoRadius || is_ruled_out(step);
  is_from_hull_ = false;
  if (is_concave()) {
    error_ = kInfinity;
    if (is_done || must_replace) ask_hull(must_replace, step);
    return step;
  }
  error_ = estimate;
  if (!is_done && must_replace) take_top_of_cuts(step);
  is_stuck_ = rule_.forbids(error_) && radius_ < kNoRadius;
  if ((rule_.allows(error_) || is_stuck_) && !is_overlap_proved_) {
    is_overlap_proved_ = -current().s <= unsearched_depth_ && have_common_point();
    if (!is_overlap_proved_) ask_hull(false, step);
  }
  return step;
}

// The line through the origins crosses the plane halfway between the tangent planes at this point. Both bodies contain it if their
// faces lie on each other, even half beside each other.
bool Ascent::have_common_point() const {
  const double height = current().jet1.h + 0.5 * current().s, whole = current().n.dot(gap_.offset());
  if (!(height > 0 && height < whole)) return false;
  const Vector3 point = height / whole * gap_.offset();
  return gap_.shape1().surely_contains(point) &&
         gap_.shape2().surely_contains(gap_.rotation().transpose() * (point - gap_.offset()));
}

// Every point p of the hull of the cuts has s(m) + rho <= m.p <= |p| for every unit m.
void Ascent::ask_hull(bool must_replace, Step& step) {
  keep_own_cut();
  const auto [point, upper, normal] = hull_.update(cuts_.points());
  is_overlap_proved_ = !is_concave() && upper <= gap_.rounding();
  if (is_overlap_proved_) return;
  error_ = is_concave() ? std::max(upper - height(), 0.0) : std::numeric_limits<double>::infinity();
  // Where s + rho is concave, more steps of the model reduce the slope, on which the bound depends. Elsewhere the model has
  // converged.
  is_hull_next_ = must_replace || !is_concave() || !is_hull_next_;
  if (!is_hull_next_) return;
  const bool is_repeated = !(upper < upper_) && (normal - hulls_normal_).norm() < kNoRadius;
  is_stuck_ = upper <= gap_.rounding() || (is_repeated && (radius_ < kNoRadius || !is_concave()));
  if (is_stuck_) return;
  upper_ = upper;
  hulls_normal_ = normal;
  if (must_replace) radius_ = std::max(0.5 * std::min(radius_, step.length), 0.5 * kNoRadius);
  // For nearly coincident points the hull loses digits. Their cuts over the tangent plane do not.
  if (is_repeated) return take_top_of_cuts(step);
  is_from_hull_ = true;
  cuts_.keep_lowest_at(normal);
  step = {normal, (normal - current().n).norm(), std::max(upper - height(), 0.0), kInfinity};
}

void Ascent::take_top_of_cuts(Step& step) {
  keep_own_cut();
  const TangentPlane plane = model_.local_model(current(), bfgs_).plane1;
  const double radius = is_concave() || radius_ < kNoRadius ? kTuning.longest_step : radius_;
  const CuttingPlanes::Maximum top = cuts_.maximize(plane, radius);
  step = {current().n + plane.lift(top.u), top.u.norm(), std::max(top.value - height(), 0.0), kInfinity};
  cuts_.keep_lowest_at(step.normal);
  if (!top.is_interior) return;
  // If the maximum of the cuts is in the interior, it bounds s + rho where this is not negative. Elsewhere it is a bound to first
  // order in every direction: s gains no more, except by the rotation itself.
  const double safety = is_concave() ? 1 : kTuning.gain_safety;
  error_ = std::min(error_, std::max(safety * step.gain + top.uncertainty, is_concave() ? -2 * height() : 0.0));
}

// Newer cuts may have replaced the cut of the current normal.
void Ascent::keep_own_cut() {
  const Vector3 own = current().d + rolling_radius_ * current().n;
  if (std::ranges::find(cuts_.points(), own) == cuts_.points().end()) cuts_.add(own);
}

bool Ascent::is_ruled_out(const Step& step) const {
  return cuts_.upper_bound(step.normal) <= (height() + kTuning.poor_share * step.gain) * step.normal.norm();
}

// Near the maximum s is constant to rounding, but its slope still gives the direction.
bool Ascent::is_level_but_flatter(double actual_gain) const {
  const auto slope = [](const GapJet& jet) { return (jet.d - jet.s * jet.n).squaredNorm(); };
  return std::abs(actual_gain) <= gap_.rounding() && slope(trial()) < slope(current());
}

void Ascent::evaluate(const Vector3& normal, std::size_t place) {
  GapJet& jet = jets_[place];
  gap_.evaluate(normal, gap_.has_hessian() ? Order::Hessian : Order::Point, jet);
  if (has_kinks_)
    exact_normals_[place] = vertices_.shared_normal(vertices_.project_witness(jet, active_[place]), jet.n).normalized();
  cuts_.add(jet.d + rolling_radius_ * jet.n);
}

// The boundary point of a body with vertices jumps. Only the smooth body's point contains a radius of curvature.
void Ascent::learn_hessian() {
  if (!has_kinks_) {
    bfgs_.update(current(), trial());
    return;
  }
  GapJet from = current(), to = trial();
  from.d = -from.jet1.r;
  to.d = -to.jet1.r;
  bfgs_.update(from, to);
}

void Ascent::adapt_radius(const Step& step, double actual_gain) {
  is_model_short_ = actual_gain > kTuning.short_share * step.gain;
  const bool is_above_rounding = step.gain > gap_.rounding();
  if (is_above_rounding && actual_gain > kTuning.good_share * step.gain) {
    radius_ = std::min(std::max(radius_, 2 * step.length), kTuning.longest_step);
  } else if (!is_above_rounding || !(actual_gain > kTuning.poor_share * step.gain)) {
    radius_ = std::max(0.5 * std::min(radius_, step.length), 0.5 * kNoRadius);
  }
}

}  // namespace supernormal
