#include "proximity/local/ascent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "proximity/answer.hpp"
#include "proximity/local/degenerate_directions.hpp"
#include "proximity/local/strict_complementarity.hpp"
#include "shapes/finite.hpp"

namespace supernormal {
namespace {

// First trust radius, the tangent of 45 degrees: the first guess is right to some ten degrees, the model rarely farther.
constexpr double kFirstRadius = 1;
constexpr double kMaxRadius = 4;

// A trust radius below the spacing of double-precision directions: no normal is left to try.
constexpr double kNoRadius = 1e-15;

// Steps that no longer lead up, though the model promises more than the tolerance, show that it is not as good as it says: s may
// rise this much farther.
constexpr double kStalledSafety = 10;

// Share of the promised gain that must come true for the trust region to grow, and below which it shrinks.
constexpr double kGoodShare = 0.5;
constexpr double kPoorShare = 0.1;

// A step through the boundary point may leave the trust region of the step through the normal by this factor.
constexpr double kFlatStepReach = 2;

// Of each component of the normal: a step that turns it by less is the same through the normal as through the boundary point.
constexpr double kSlightTurn = 0.01;

// A step through the boundary point that is shorter than the step through the normal by this factor, and promises a small share of
// its gain only, creeps along an edge between two flat faces: the step through the normal is tried.
constexpr double kCreep = 1e-2;

// A corner or an edge adds no curvature to that of a flat face: the step that rises to it may be so many times too short.
constexpr double kCornerSafety = 3;

// Steps through the boundary point that do not shrink to this share may be much too short: where the other body is an edge that
// turns, as a rim, it turns less and less as the normal leaves the face.
constexpr double kSlowFlatSteps = 0.5;
constexpr double kSlowFlatSafety = 20;

// Directions closer than this (radians) to the plane of another have no useful gnomonic coordinates.
constexpr double kGrazing = 1e-15;

// The distance between two unit normals a quarter turn apart, sqrt(2).
constexpr double kQuarterTurnChord = 1.4142135623730951;

// Where a level maximum of the cuts is probed: a normal that is turned by sqrt(2 tolerance / depth) may be higher by the tolerance
// without bending. A cut of there reaches from 0.6 to more than 2 times as far.
constexpr double kProbe = 2;

// The next look for a rise across a flat spot is so many times as far away, where s may gain the square of it as much; none is
// farther than this (gnomonic).
constexpr double kFartherLook = 2;
constexpr double kFarthestLook = 1;

// From there the ridge is this share of the way off, at most.
constexpr double kRidgeReach = 0.5;

// Without Hessians, a curvature that is less than so many times the depth, and so small a share of the pair's length, as at sharp
// tips, may be less than the depth just beyond where it was seen.
constexpr double kWeakCurvature = 4;
constexpr double kTipRadius = 0.01;

/// Of the solutions u1, u2 that the two bodies propose, each counted by its own radii of curvature: (A1 + A2)^-1 (A1 u1 + A2 u2).
/// As what the rounder body changes of the flatter one's, which counts alone where the sum is that of an edge, singular.
Vector2 blend(const Symmetric2& A1, const Symmetric2& A2, const Vector2& u1, const Vector2& u2) {
  const bool is_first_flatter = A1.trace() > A2.trace();
  const Vector2& flat = is_first_flatter ? u1 : u2;
  const Vector2 pull = is_first_flatter ? A2 * (u2 - u1) : A1 * (u1 - u2);
  const Vector2 change = (A1 + A2).solve(pull);
  return all_finite(change) ? Vector2(flat + change) : flat;
}

/// The gnomonic coordinates of a direction; false if it is not on the side of the plane's normal, or grazes the plane.
bool to_plane(const TangentPlane& plane, const Vector3& direction, Vector2& u) {
  const double height = direction.dot(plane.n);
  if (!(height > kGrazing * direction.norm())) return false;
  u = plane.project(direction) / height;
  return true;
}

/// Whether there may be flat faces that are not across the axes of the body's frame.
bool may_be_tilted(const Shape& shape) { return shape.has_flat_faces() && shape.as_superellipsoid() == nullptr; }

/// What the model says of the step u.
RemainingGainEstimate::Promise promise(const LocalModel& local, double gain, const Vector2& u) {
  return {gain, u.norm(), local.model.A, local.plane1, u};
}

/// Of at least one piece; before curvature.
double lowest_rise(std::span<const Piece> pieces, const Vector2& u) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces) lowest = std::min(lowest, piece.at(u));
  return lowest;
}

}  // namespace

Ascent::Ascent(GapFunction& gap, CuttingPlanes& cuts, const Settings& settings, double tolerance)
    : gap_(gap),
      cuts_(cuts),
      settings_(settings),
      tolerance_(tolerance),
      rolling_radius_(gap.rolling_radius()),
      has_flat_faces_(gap.has_hessian() && (gap.shape1().has_flat_faces() || gap.shape2().has_flat_faces())),
      may_be_tilted_(may_be_tilted(gap.shape1()) || may_be_tilted(gap.shape2())),
      has_kinks_(gap.shape2().has_kinks()),
      known_(gap),
      to_come_(gap, tolerance) {}

Status Ascent::climb(const Vector3& start, double cutoff) {
  forget_steps();
  evaluate(start, current(), corners_[now_]);
  if (!gap_.has_hessian()) secant_.restart(current());
  return climb_on(cutoff);
}

Status Ascent::climb(const GapJet& start) {
  forget_steps();
  current() = start;
  return climb_on(-std::numeric_limits<double>::infinity());
}

Status Ascent::climb_on(double cutoff) {
  Status status = Status::Converged;
  while (true) {
    if (!current().is_finite()) return Status::InvalidInput;
    if (settings_.stop_when_apart && current().s > 0) return Status::Apart;
    const Step step = choose_step();
    if (finished(cutoff, status)) {
      if (status == Status::Converged && leave_flat_spot()) continue;
      if (status == Status::Stalled) error_ *= kStalledSafety;
      // What was asked for is not reached: no curvature that was seen on the way is believed to hold the normal.
      if (status != Status::Converged) error_ = std::max(error_, turn_gain(kQuarterTurnChord));
      return status;
    }
    evaluate(step.normal.normalized(), trial(), corners_[1 - now_]);
    if (!gap_.has_hessian()) learn_curvature();
    const double actual_gain = trial().s - current().s;
    adapt_radius(step, actual_gain);
    if (actual_gain > kPoorShare * step.gain) use_cutting_plane_step_ = false;
    if (actual_gain > 0 || is_level_but_flatter(actual_gain)) {
      now_ = 1 - now_;
    } else {
      to_come_.forget();
    }
  }
}

void Ascent::forget_steps() {
  radius_ = kFirstRadius;
  flat_length_ = std::numeric_limits<double>::infinity();
  use_cutting_plane_step_ = false;
  to_come_.restart();
}

bool Ascent::finished(double cutoff, Status& status) const {
  const bool is_proved = optimality_gap_bound(current(), rolling_radius_) <= tolerance_;
  if (error_ <= tolerance_ || is_proved) {
    status = Status::Converged;
  } else if (gap_.evaluations() >= settings_.max_evaluations) {
    status = Status::EvaluationLimit;
  } else if (radius_ < kNoRadius || current().s + error_ < cutoff) {
    status = Status::Stalled;
  } else {
    return false;
  }
  return true;
}

LocalModel Ascent::local_model(const GapJet& jet) const {
  return gap_.has_hessian() ? LocalModel::of(gap_, jet) : LocalModel::of(gap_, jet, secant_.matrix());
}

Ascent::Step Ascent::choose_step() {
  const LocalModel local = local_model(current());
  Step step = has_kinks_ ? kinked_step(local) : smooth_step(local);
  // Where the steps zigzag across a ridge the model sees no further than they go; the cuts of both sides do.
  use_cutting_plane_step_ = use_cutting_plane_step_ || to_come_.may_zigzag();
  if (use_cutting_plane_step_ || (error_ > tolerance_ && (is_open_ || ruled_out(step)))) cut_step(local, step);
  if (use_cutting_plane_step_) {
    error_ = std::max(error_, step.gain);
    use_cutting_plane_step_ = step.gain > tolerance_;
  }
  return step;
}

void Ascent::cut_step(const LocalModel& local, Step& step) {
  // Newer ones may have taken its place.
  if (std::ranges::find(cuts_.points(), current().d) == cuts_.points().end()) cuts_.add(current().d);
  const CuttingPlanes::Maximum top = cuts_.maximize(local.plane1, radius_);
  step = {current().n + local.plane1.lift(top.u), top.u.norm(), std::max(top.value - current().s, 0.0)};
  // The cuts bound s over the whole plane where their maximum is not on the rim.
  if (!top.is_interior) return;
  const double error = RemainingGainEstimate::kSafety * step.gain + top.uncertainty;
  const double turn = turn_gain(unverified_angle(local)) + turn_to_come(local);
  if (current().s >= 0 || (Eigen2(local.model.A).low > 0 && turn <= tolerance_)) {
    error_ = std::min(error_, error + turn);
  } else {
    probe_step(local, top, error, step);
  }
}

// The cuts bound s times the length of n + u, which tells nothing of what s gains by the turn alone, as far as the model's maximum.
double Ascent::turn_to_come(const LocalModel& local) const {
  if (has_kinks_ || current().s >= 0) return 0;
  const Vector2 newton = local.model.A.solve(local.model.g);
  return all_finite(newton) ? -0.5 * current().s * std::min(newton.squaredNorm(), kMaxRadius * kMaxRadius) : 0;
}

// Overlapping bodies come nearer as the normal turns away, unless they bend. Where they do not, as two vertices, the cuts must come
// down around their maximum as well: steeper than s = level cos(turn). Where they do not yet, the next step is as far that way as
// matters for the tolerance; it finds higher normals, or its cut comes down.
void Ascent::probe_step(const LocalModel& local, const CuttingPlanes::Maximum& top, double error, Step& step) {
  const double matters = tolerance_radius();
  const CuttingPlanes::Reach reach = cuts_.reach(local.plane1, top.u, current().s, matters);
  const double distance = top.u.norm() + reach.distance;
  const double rise = 0.5 * -current().s * distance * distance;
  error_ = std::min(error_, error + RemainingGainEstimate::kSafety * rise);
  if (error > tolerance_ || error_ <= tolerance_) return;
  const Vector2 u = top.u + std::min(reach.distance, matters) * reach.way;
  step = {current().n + local.plane1.lift(u), u.norm(), rise};
}

double Ascent::tolerance_radius() const { return kProbe * std::sqrt(tolerance_ / -current().s); }

Ascent::Step Ascent::smooth_step(const LocalModel& local) {
  const auto [newton, whole_gain] = local.model.peak(radius_, gap_.rounding());
  error_ = to_come_.learn(promise(local, whole_gain, newton), radius_);
  error_ = std::max(error_, unverified_gain(local, local.model.g, true));
  Step step{current().n + local.plane1.lift(newton), newton.norm(), std::max(local.model.gain(newton), 0.0)};
  if (has_flat_faces_ && !parametrizations_agree(local, newton) &&
      flat_step(local, {0, local.model.g, newton, nullptr, {}}, step) == FlatStep::LeavesFace) {
    leave_face(local, step);
  }
  return step;
}

Ascent::Step Ascent::kinked_step(const LocalModel& local) {
  const std::span<const Piece> pieces = known_.pieces(current(), corners_[now_], local.plane1);
  const double least_slope = current().s < 0 ? -0.5 * current().s * tolerance_radius() : 0;
  const StrictComplementarity hold(least_slope, gap_.rounding(), gap_.length_unit());
  PiecewiseModel model{pieces, hold.reduced_hessian(local.model.A, pieces)};
  bool is_concave = Eigen2(model.A).low > 0;
  PiecewiseModel::Peak peak;
  if (is_concave) {
    peak = model.maximize();
    if (model.A != local.model.A && !hold.is_held(peak, pieces, local.model.A)) {
      model.A = local.model.A;
      is_concave = false;
    }
  }
  // Here the model is 0; where its matrix is as good as singular, rounding may leave it without a maximum that is not lower.
  const bool has_maximum = is_concave && peak.gain >= -gap_.rounding();
  const double whole_gain = has_maximum ? std::max(peak.gain, 0.0) : std::numeric_limits<double>::infinity();
  if (!is_concave || peak.u.norm() > radius_) peak = model.maximize(radius_);
  error_ = to_come_.learn(promise(local, whole_gain, peak.u), radius_);

  Target target{0, Vector2::Zero(), peak.u, &peak, pieces};
  for (std::size_t i = 0; i < peak.count; ++i) {
    target.value += peak.weight[i] * pieces[peak.active[i]].value;
    target.slope += peak.weight[i] * pieces[peak.active[i]].slope;
    if (peak.count > 1) cuts_.add(known_.difference(current(), peak.active[i]));
  }
  error_ = std::max(error_, unverified_gain(local, target.slope, peak.count == 1));
  if (local.A1.trace() > kFlatRadius * gap_.length_unit()) {
    // On a face this flat the turn of the normal drowns in the rounding of u, but not the way that the boundary point is to move.
    const Vector2 way = target.slope - local.A2 * peak.u - current().s * peak.u;
    const Vector2 turn = local.A1.solve(way);
    if (all_finite(turn)) target.newton = turn;
  }
  const Vector3 normal = known_.shared_normal(peak, current().n + local.plane1.lift(peak.u));
  Step step{normal, peak.u.norm(), std::max(peak.gain, 0.0)};
  // ActiveVertices around the peak hold the normal whatever the curvature, which on a flat face says nothing a little farther on.
  const bool is_at_face = peak.count == 3 && hold.is_held(peak, pieces, {});
  if (has_flat_faces_ && !is_at_face && flat_step(local, target, step) != FlatStep::Taken) {
    target.newton = peak.u;
    if (flat_step(local, target, step) != FlatStep::Taken) leave_face(local, step);
  }
  Vector3 face;
  if (gap_.shape2().crosses_curved_face(current().m, -(gap_.rotation().transpose() * step.normal), face)) {
    step.normal = -(gap_.rotation() * face);
  }
  return step;
}

bool Ascent::curvature_holds() const { return gap_.has_hessian() && !to_come_.near_degenerate_stationary_point(); }

// Two vertices that overlap come nearer whichever way the normal turns: as far as no curvature has been seen to hold it back, or
// where that is about to end. Only a ball as large as the overlap that rolls inside the bodies holds it for certain. Radii that
// were sampled or estimated do not: below an exponent of 2 they vanish at the vertices, and are rather large beside them.
double Ascent::turn_gain(double reach) const {
  if (curvature_holds() || -current().s <= rolling_radius_) return 0;
  const double turn = std::min(reach, kQuarterTurnChord);
  return -0.5 * turn * turn * current().s;
}

double Ascent::unverified_angle(const LocalModel& local) const {
  const bool is_weak = Eigen2(local.model.A).low < std::min(kWeakCurvature * -current().s, kTipRadius * gap_.length_unit());
  return is_weak ? kQuarterTurnChord : secant_.reach();
}

// Along the slope, where the model does not tell how far it goes on: of bodies without Hessians, and where the steps grow, as along
// the normals of a sharp tip, or where the curvature is about to end. However far, s gains no more than slope sin(turn) by it. And
// with the turn itself.
double Ascent::unverified_gain(const LocalModel& local, const Vector2& slope, bool is_held_by_curvature) {
  is_open_ = false;
  if (curvature_holds() && !to_come_.steps_grow()) return 0;
  const double along_slope = slope.norm();
  const double turn = is_held_by_curvature ? turn_gain(unverified_angle(local)) : 0;
  is_open_ = along_slope <= tolerance_ && turn > tolerance_;
  return along_slope + turn;
}

// Of a body with flat faces across its axes the boundary point is a function of the normal's components over their sizes: where
// these hardly change, both steps are the same.
bool Ascent::parametrizations_agree(const LocalModel& local, const Vector2& newton) const {
  if (may_be_tilted_) return false;
  const auto is_less = [](const Vector3& turn, const Vector3& normal) {
    return (turn.array().abs() <= kSlightTurn * normal.array().abs()).all();
  };
  return is_less(local.plane1.lift(newton), current().n) && is_less(local.plane2.lift(newton), current().m);
}

// What is opposite lies beyond the flat face, where the curvature here says nothing.
void Ascent::leave_face(const LocalModel& local, Step& step) {
  error_ = std::numeric_limits<double>::infinity();
  cut_step(local, step);
}

Ascent::FlatStep Ascent::flat_step(const LocalModel& local, const Target& target, Step& step) {
  const Vector2& newton = target.newton;
  Vector2 u1, u2;
  const Vector3 normal1 = gap_.shape1().advance_normal(current().n, current().jet1, local.plane1.lift(newton));
  const Vector3 normal2 = -gap_.shape2().advance_normal(current().m, current().jet2, -local.plane2.lift(newton));
  if (!to_plane(local.plane1, normal1, u1) || !to_plane(local.plane2, normal2, u2)) return FlatStep::LeavesFace;
  Vector2 u = blend(local.A1, local.A2, u1, u2);
  if (!all_finite(u)) return FlatStep::None;
  if (target.peak != nullptr) {
    // An edge holds the normal only while the point of body 1 stays between its corners: where this turn rises for all of them, it
    // does not.
    error_ = std::max(error_, kCornerSafety * lowest_rise(target.pieces, u));
    const Vector3 normal = known_.shared_normal(*target.peak, current().n + local.plane1.lift(u));
    if (!to_plane(local.plane1, normal, u)) return FlatStep::LeavesFace;
  }
  double rise = target.value + target.slope.dot(u);
  if (!(rise > 0)) return FlatStep::None;
  // s is concave where it matters: it gains at most the slope times the step, however flat the face.
  const double length = std::hypot(u.x(), u.y());  // may be too small to square
  const double safety =
      (target.peak != nullptr ? kCornerSafety : 1) * (length < kSlowFlatSteps * flat_length_ ? 1 : kSlowFlatSafety);
  error_ = std::max(error_, safety * rise);
  flat_length_ = length;
  const double reach = kFlatStepReach * radius_;
  const double shrink = length > reach ? reach / length : 1;
  if (length < kCreep * newton.norm() && rise < kPoorShare * step.gain) return FlatStep::Taken;
  u *= shrink;
  Vector3 normal = current().n + local.plane1.lift(u);
  if (target.peak != nullptr) normal = known_.shared_normal(*target.peak, normal);
  step = {normal, u.norm(), std::min(step.gain, shrink * rise)};
  return FlatStep::Taken;
}

// A look at the distance that matters tells whether a flat spot holds the normal, and those farther on, since just beyond the spot
// s may be level; unless a cut does.
bool Ascent::leave_flat_spot() {
  if (!has_flat_faces_ || -current().s <= std::max(rolling_radius_, tolerance_)) return false;
  const LocalModel local = local_model(current());
  const double nearest = tolerance_radius();
  const DegenerateDirections across(gap_, local, nearest);
  const auto rises_along = [&](const Vector2& way) {
    double distance = std::copysign(nearest, local.model.g.dot(way));
    while (std::abs(distance) <= kFarthestLook && !rises_beyond(local, distance * way)) distance *= kFartherLook;
    return std::abs(distance) <= kFarthestLook;
  };
  if (!std::ranges::any_of(across.ways(), rises_along)) return false;
  now_ = 1 - now_;
  forget_steps();
  return true;
}

// The ridge of the hill that s may climb there need not lie where it is looked for: a step of the model there leads to it.
bool Ascent::rises_beyond(const LocalModel& local, const Vector2& u) {
  if (!can_rise(current().n + local.plane1.lift(u))) return false;
  if (is_higher(trial().s)) return true;
  const LocalModel there = local_model(trial());
  const Vector2 step = there.model.maximize(kRidgeReach * u.norm());
  return is_higher(trial().s + there.model.gain(step)) && can_rise(trial().n + there.plane1.lift(step)) && is_higher(trial().s);
}

bool Ascent::can_rise(const Vector3& direction) {
  const Vector3 normal = direction.normalized();
  if (cuts_.upper_bound(normal) <= current().s || gap_.evaluations() >= settings_.max_evaluations) return false;
  evaluate(normal, trial(), corners_[1 - now_]);
  return true;
}

bool Ascent::is_higher(double s) const { return s > current().s + gap_.rounding(); }

bool Ascent::ruled_out(const Step& step) const {
  return cuts_.upper_bound(step.normal) <= (current().s + kPoorShare * step.gain) * step.normal.norm();
}

bool Ascent::is_level_but_flatter(double actual_gain) const {
  const auto slope = [](const GapJet& jet) { return (jet.d - jet.s * jet.n).squaredNorm(); };
  return std::abs(actual_gain) <= gap_.rounding() && slope(trial()) < slope(current());
}

void Ascent::evaluate(const Vector3& normal, GapJet& jet, ActiveVertices& corners) {
  gap_.evaluate(normal, gap_.has_hessian() ? Order::Hessian : Order::Point, jet);
  if (has_kinks_) known_.project_witness(jet, corners);
  cuts_.add(jet.d);
}

// Of a body with corners the boundary point jumps: only the smooth body's tells a curvature.
void Ascent::learn_curvature() {
  if (!has_kinks_) {
    secant_.update(current(), trial());
    return;
  }
  GapJet from = current(), to = trial();
  from.d = -from.jet1.r;
  to.d = -to.jet1.r;
  secant_.update(from, to);
}

void Ascent::adapt_radius(const Step& step, double actual_gain) {
  if (actual_gain > kGoodShare * step.gain) {
    radius_ = std::min(std::max(radius_, 2 * step.length), kMaxRadius);
  } else if (!(actual_gain > kPoorShare * step.gain)) {
    radius_ = std::max(0.5 * std::min(radius_, step.length), 0.5 * kNoRadius);
  }
}

}  // namespace supernormal
