#include "proximity/search/ascent.hpp"

#include <algorithm>
#include <cmath>

#include "proximity/search/answer.hpp"

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
      has_nonsmooth_points_(gap.traits2().has_nonsmooth_points),
      vertices_(gap),
      model_(gap, vertices_, cuts) {}

Status Ascent::climb(const Vector3& start, double cutoff) {
  evaluate(start, here());
  if (!gap_.has_hessian()) bfgs_.restart(here().jet);
  return climb_on(cutoff);
}

Status Ascent::climb(const GapJet& start) {
  here().jet = start;
  here().cut = cut_of(start);
  return climb_on(-kInfinity);
}

Status Ascent::climb_on(double cutoff) {
  memory_ = {};
  here().is_by_estimate = true;
  while (true) {
    if (!here().jet.is_finite()) return Status::InvalidInput;
    if (rule_.is_apart(here().jet)) return Status::Apart;
    // Lemma 2 with one evaluation needs no model. With colliders of known vertices it ends nearly every warm query.
    error_ = optimality_gap_bound(here().jet, rolling_radius_);
    if (rule_.allows(error_) && here().is_by_estimate) return Status::Converged;

    const auto [step, proposer] = propose();
    if (const std::optional<Status> end = end_of_climb(proposer, cutoff)) {
      if (has_nonsmooth_points_ && !here().is_by_estimate) move_to_exact_normal();
      return *end;
    }

    evaluate(step.normal.normalized(), trial());  // adds the cut of lemma 1
    if (!gap_.has_hessian()) learn_hessian();
    const double actual_gain = trial().jet.s - here().jet.s;
    if (proposer != Proposer::Hull) learn_radius(step, actual_gain);
    if (actual_gain > 0 || is_level_but_flatter(actual_gain)) {
      // Lemma 3 does not hold in an overlap: the hull's normal may be in another basin of attraction.
      if (proposer == Proposer::Hull && !is_concave()) memory_.radius = kTuning.longest_step;
      here_ = 1 - here_;
      here().is_by_estimate = step.remaining_gain != kInfinity;
    } else if (proposer == Proposer::Hull && trial().jet.s > candidate_.s) {
      candidate_ = {trial().jet.n, trial().jet.s};
    }
  }
}

std::optional<Status> Ascent::end_of_climb(Proposer proposer, double cutoff) const {
  if (rule_.allows(error_) || rule_.allows(optimality_gap_bound(here().jet, rolling_radius_))) return Status::Converged;
  if (!rule_.may_evaluate()) return Status::EvaluationLimit;
  if (proposer == Proposer::Nobody || here().jet.s + error_ < cutoff) return Status::Stalled;
  return std::nullopt;
}

// Sets the error with which the climb may end.
Ascent::Proposal Ascent::propose() {
  const Step models = model_.propose(here().jet, here().active, bfgs_, memory_.radius);
  const double estimate = model_.leaves_face() ? std::numeric_limits<double>::infinity() : models.remaining_gain;
  const bool is_refused =
      model_.leaves_face() || memory_.prediction == Prediction::TooLow || memory_.radius < kNoRadius || is_ruled_out(models);
  return is_concave() ? propose_where_concave(models, rule_.allows(estimate), is_refused)
                      : propose_in_overlap(models, estimate, is_refused);
}

// Lemma 3: there is one maximum, and lemma 2 proves it. Every point p of the hull of the cuts has s(m) + rho <= |p| for all m.
Ascent::Proposal Ascent::propose_where_concave(const Step& models, bool is_converged, bool is_refused) {
  error_ = kInfinity;
  if (!is_converged && !is_refused) return {models, Proposer::Model};
  keep_own_cut();
  const MinimumNormPoint nearest = hull_.update(cuts_.points());
  is_overlap_proved_ = false;
  error_ = std::max(nearest.norm - height(), 0.0);
  // More steps of the model reduce the slope, on which the bound depends.
  const bool is_models_turn = !is_refused && memory_.last_asked == Proposer::Hull;
  memory_.last_asked = is_models_turn ? Proposer::Model : Proposer::Hull;
  if (is_models_turn) return {models, Proposer::Model};
  const Proposal proposal = nearest_of_hull(nearest);
  if (is_refused) shrink_radius(models.length);
  return proposal;
}

// No bound is local. The estimate ends the climb once the overlap is proved ("Proof of an overlap").
Ascent::Proposal Ascent::propose_in_overlap(const Step& models, double estimate, bool is_refused) {
  error_ = estimate;
  Proposal proposal{models, Proposer::Model};
  if (is_refused && !rule_.allows(estimate)) proposal = highest_of_cuts();
  if (rule_.forbids(error_) && memory_.radius < kNoRadius) proposal.proposer = Proposer::Nobody;
  const bool may_end = rule_.allows(error_) || proposal.proposer == Proposer::Nobody;
  if (!may_end || is_overlap_proved_) return proposal;

  is_overlap_proved_ = -here().jet.s <= unsearched_depth_ && have_common_point();
  if (is_overlap_proved_) return proposal;
  keep_own_cut();
  const MinimumNormPoint nearest = hull_.update(cuts_.points());
  is_overlap_proved_ = nearest.norm <= gap_.rounding();
  if (is_overlap_proved_) return proposal;
  error_ = kInfinity;
  memory_.last_asked = Proposer::Hull;
  return nearest_of_hull(nearest);
}

// The direction of the hull's nearest point: a step of GJK.
Ascent::Proposal Ascent::nearest_of_hull(const MinimumNormPoint& nearest) {
  const bool is_repeated = !(nearest.norm < memory_.upper) && (nearest.normal - memory_.hulls_normal).norm() < kNoRadius;
  const bool is_exhausted = is_repeated && (memory_.radius < kNoRadius || !is_concave());
  if (nearest.norm <= gap_.rounding() || is_exhausted) return {{}, Proposer::Nobody};
  memory_.upper = nearest.norm;
  memory_.hulls_normal = nearest.normal;
  // For nearly coincident points the hull loses digits. Their cuts over the tangent plane do not.
  if (is_repeated) return highest_of_cuts();
  cuts_.keep_lowest_at(nearest.normal);
  const double length = (nearest.normal - here().jet.n).norm();
  return {{nearest.normal, length, std::max(nearest.norm - height(), 0.0), kInfinity}, Proposer::Hull};
}

// The highest point of the cuts of lemma 1 over the tangent plane. May lower the error.
Ascent::Proposal Ascent::highest_of_cuts() {
  keep_own_cut();
  const TangentPlane plane = model_.local_model(here().jet, bfgs_).plane1;
  const double radius = is_concave() || memory_.radius < kNoRadius ? kTuning.longest_step : memory_.radius;
  const CuttingPlanes::Maximum top = cuts_.maximize(plane, radius);
  const Step step{here().jet.n + plane.lift(top.u), top.u.norm(), std::max(top.value - height(), 0.0), kInfinity};
  cuts_.keep_lowest_at(step.normal);
  if (top.is_interior) {
    // It then bounds s + rho where this is not negative. Elsewhere it is a bound to first order in every direction: s gains no
    // more, except by the rotation itself.
    const double safety = is_concave() ? 1 : kTuning.gain_safety;
    error_ = std::min(error_, std::max(safety * step.gain + top.uncertainty, is_concave() ? -2 * height() : 0.0));
  }
  return {step, Proposer::Cuts};
}

// Lemma 1: the cuts leave less than a part of the predicted gain.
bool Ascent::is_ruled_out(const Step& step) const {
  return cuts_.upper_bound(step.normal) <= (height() + kTuning.poor_fraction * step.gain) * step.normal.norm();
}

// The line through the origins crosses the plane halfway between the tangent planes at this point. Both bodies contain it if their
// faces lie on each other, even half beside each other.
bool Ascent::have_common_point() const {
  const GapJet& jet = here().jet;
  const double height = jet.jet1.h + 0.5 * jet.s, whole = jet.n.dot(gap_.offset());
  if (!(height > 0 && height < whole)) return false;
  const Vector3 point = height / whole * gap_.offset();
  return gap_.shape1().surely_contains(point) &&
         gap_.shape2().surely_contains(gap_.rotation().transpose() * (point - gap_.offset()));
}

// Apart from rounding, a normal from the bounds is the normal of a face or an edge of body 2, and the boundary point is one of its
// vertices. The model's step goes to the exact normal. There any point between the vertices is a boundary point.
void Ascent::move_to_exact_normal() {
  const Step step = model_.propose(here().jet, here().active, bfgs_, kTuning.longest_step);
  if (model_.leaves_face() || !rule_.may_evaluate()) return;
  evaluate(step.normal.normalized(), trial());
  // If a bound has proved the present normal, it must prove the other one, too.
  const bool is_as_good = rule_.allows(error_) || rule_.allows(optimality_gap_bound(trial().jet, rolling_radius_));
  if (is_as_good && trial().jet.s >= here().jet.s - gap_.rounding()) here_ = 1 - here_;
}

// Near the maximum s is constant to rounding, but its slope still gives the direction.
bool Ascent::is_level_but_flatter(double actual_gain) const {
  const auto slope = [](const GapJet& jet) { return (jet.d - jet.s * jet.n).squaredNorm(); };
  return std::abs(actual_gain) <= gap_.rounding() && slope(trial().jet) < slope(here().jet);
}

void Ascent::evaluate(const Vector3& normal, Point& point) {
  GapJet& jet = point.jet;
  gap_.evaluate(normal, gap_.has_hessian() ? Order::Hessian : Order::Point, jet);
  if (has_nonsmooth_points_) {
    point.exact_normal = vertices_.shared_normal(vertices_.project_witness(jet, point.active), jet.n).normalized();
  }
  point.cut = cut_of(jet);
  cuts_.add(point.cut);
}

// Newer cuts may have replaced the cut of the present normal. It is compared as stored: calculated again, it may have more digits
// (x87).
void Ascent::keep_own_cut() {
  if (std::ranges::find(cuts_.points(), here().cut) == cuts_.points().end()) cuts_.add(here().cut);
}

// The boundary point of a body with vertices jumps. Only the smooth body's point contains a radius of curvature.
void Ascent::learn_hessian() {
  if (!has_nonsmooth_points_) {
    bfgs_.update(here().jet, trial().jet);
    return;
  }
  GapJet from = here().jet, to = trial().jet;
  from.d = -from.jet1.r;
  to.d = -to.jet1.r;
  bfgs_.update(from, to);
}

void Ascent::learn_radius(const Step& step, double actual_gain) {
  memory_.prediction = actual_gain > kTuning.short_fraction * step.gain ? Prediction::TooLow : Prediction::Good;
  const bool is_above_rounding = step.gain > gap_.rounding();
  if (is_above_rounding && actual_gain > 0.5 * step.gain) {
    memory_.radius = std::min(std::max(memory_.radius, 2 * step.length), kTuning.longest_step);
  } else if (!is_above_rounding || !(actual_gain > kTuning.poor_fraction * step.gain)) {
    shrink_radius(step.length);
  }
}

void Ascent::shrink_radius(double length) { memory_.radius = std::max(0.5 * std::min(memory_.radius, length), 0.5 * kNoRadius); }

}  // namespace supernormal
