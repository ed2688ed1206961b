#include "raycast/ray_entry.hpp"

#include <algorithm>
#include <cmath>

#include "base/finite.hpp"
#include "proximity/local/local_model.hpp"

namespace supernormal {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// A normal within this cosine of perpendicular to the line counts as perpendicular. Its boundary point is on the silhouette, to the
// square of this times a radius of curvature.
constexpr double kGrazing = 1e-9;

// A longer step (tangent of the angle) is due to rounding.
constexpr double kLongestStep = 1e4;

// A step of the paraboloid should reduce the remaining error by this factor.
constexpr double kGoodContraction = 0.5;

// The remaining error is summed as a geometric series. Its contraction is measured from the last two steps, and at least this.
constexpr double kSlowestContraction = 0.95;
constexpr double kGainSafety = 3;

// rad; a longer step may reach a different curvature, so its contraction is not used.
constexpr double kAsymptoticStep = 1e-3;

// Beside the body: the number of steps of the paraboloid in a row that may fail to halve the sector.
constexpr int kMaxSlowSteps = 2;

// Once the point is good, the normal gets at most this many more steps. On a flat face rounding may limit the point first.
constexpr int kMaxPolishingSteps = 32;

// The search ends after kMaxIdleSteps that change nothing. It also ends after kMaxFruitlessSteps without progress: a better plane,
// or a distance from the plane to the portal that is smaller by kProgress.
constexpr int kMaxIdleSteps = 60;
constexpr int kMaxFruitlessSteps = 150;
constexpr double kProgress = 0.99;

// Tangent of an angle: the stored points propose a normal within this of the best normal.
constexpr double kLargestTilt = 100;

// m; a smaller radius of curvature is an edge or a vertex, to rounding. There is no paraboloid there, and a division would
// overflow.
constexpr double kSharpestRadius = 1e-100;

// The rounding error of the portal's height above the best plane, in units of GapFunction::rounding(). The plane adds one unit. The
// points of a steep portal add a little more than one.
constexpr double kPortalRounding = 3;

// In tolerances: the line certainly enters a paraboloid that it cuts by this depth.
constexpr double kSureDepth = 100;

bool is_curved(const Symmetric2& A) {
  const double size = A.trace();
  return size > kSharpestRadius && A.xx * (A.yy / size) - A.xy * (A.xy / size) > kSharpestRadius;
}

// Whether products with lengths, and products of four such numbers, stay in range.
bool is_in_range(const Vector2& u) { return std::abs(u.x()) < 1e60 && std::abs(u.y()) < 1e60; }

/// The smaller root of a t^2 + 2 b t + c with a >= 0. Without a root it is the minimum. It is infinite if there is neither, for a
/// straight line that does not fall.
double first_root(double a, double b, double c) {
  constexpr double kStraight = 1e-150;
  const double discriminant = b * b - a * c;
  const double root = std::sqrt(std::max(discriminant, 0.0));
  if (discriminant > 0 && b < 0) return c / (root - b);
  return a > kStraight ? -(b + root) / a : kUnbounded;
}

}  // namespace

Vector3 first_entry_normal(const Vector3& half_extents, const Vector3& c, const Vector3& v) {
  constexpr double kThinnest = 1e-12;  // relative to the largest half-extent; a flat body gets this thickness
  const double largest = half_extents.maxCoeff();
  if (largest == 0) return -v;
  const Vector3 half = half_extents.cwiseMax(kThinnest * largest);
  const Vector3 scaled_c = c.cwiseQuotient(half);
  const Vector3 scaled_v = v.cwiseQuotient(half);
  const double squared_v = scaled_v.squaredNorm();
  const Vector3 foot = scaled_c - scaled_c.dot(scaled_v) / squared_v * scaled_v;
  const double inside = 1 - foot.squaredNorm();
  if (inside > 0) return (foot - std::sqrt(inside / squared_v) * scaled_v).cwiseQuotient(half).normalized();
  const Vector3 n = foot.cwiseQuotient(half);
  return (n - n.dot(v) * v).normalized();
}

EntrySearch::EntrySearch(GapFunction& gap, const Vector3& direction, const Settings& settings)
    : gap_(gap), v_(direction), settings_(settings), rule_(gap, settings), portal_(direction, gap.rounding()) {}

EntrySearch::Result EntrySearch::run(const Vector3& first_normal, double limit) {
  Vector3 normal = first_normal;
  while (true) {
    evaluate(normal);
    if (!is_finite_) return {};
    if (misses_) return {Kind::Miss, Status::Converged, 0, 0, 0, beside_.jet.n};
    if (has_best_ && best_.t > limit) return {Kind::Beyond, Status::Converged, best_.t, 0, 0, best_.jet.n};
    const Step step = paraboloid_step();
    if (!is_beside_latest_) {
      model_error_ = std::min(model_error_, expected_error(step));
      is_deep_ = step.is_deep;
    }
    if (has_settled(step)) return found(Status::Converged);
    if (!rule_.may_evaluate()) return found(Status::EvaluationLimit);
    if (!choose(step, normal)) return found(rule_.allows(boundary_error()) ? Status::Converged : Status::Stalled);
  }
}

void EntrySearch::evaluate(const Vector3& normal) {
  const Vector3 n = normal.normalized();
  const double slope = n.dot(v_);
  if (!(slope < -kGrazing)) return evaluate_beside((n - slope * v_).normalized());
  Sample sample;
  gap_.evaluate(n, gap_.has_hessian() ? Order::Hessian : Order::Point, sample.jet);
  is_finite_ = sample.jet.is_finite();
  sample.slope = slope;
  sample.t = sample.jet.s / -slope;
  const double upper_bound = portal_.upper_bound();
  const bool is_kept = add_point(sample.jet.d);
  is_beside_latest_ = false;
  if (!gap_.has_hessian()) has_best_ ? secant_.update(best_.jet, sample.jet) : secant_.restart(sample.jet);
  const bool is_lower = portal_.upper_bound() - best_.t < kProgress * (upper_bound - best_.t);
  const bool is_best = !has_best_ || is_better(sample);
  if (is_best) {
    best_ = sample;
    model_error_ = point_error_ = kUnbounded;
  }
  if (is_best || !gap_.has_hessian()) was_tried_ = false;
  has_best_ = true;
  idle_steps_ = is_best || is_kept ? 0 : idle_steps_ + 1;
  fruitless_steps_ = is_best || is_lower ? 0 : fruitless_steps_ + 1;
}

// Near the maximum t is constant to rounding. The boundary point still approaches the line.
bool EntrySearch::is_better(const Sample& sample) const {
  const double level = gap_.rounding() / -sample.slope;
  if (!(sample.t <= best_.t + level)) return true;  // also when `t` is NaN
  return sample.t >= best_.t - level && distance_at(sample).squaredNorm() < distance_at(best_).squaredNorm();
}

void EntrySearch::evaluate_beside(const Vector3& normal) {
  const double sector = portal_.sector();
  gap_.evaluate(normal, gap_.has_hessian() ? Order::Hessian : Order::Point, beside_.jet);
  is_finite_ = beside_.jet.is_finite();
  misses_ = beside_.jet.s >= 0;
  beside_.t = v_.dot(beside_.jet.jet1.r);
  if (beside_.jet.s > nearest_) {
    nearest_ = beside_.jet.s;
    nearest_normal_ = normal;
  }
  if (add_point(beside_.jet.d)) idle_steps_ = 0;
  slow_steps_ = portal_.sector() > kGoodContraction * sector ? slow_steps_ + 1 : 0;
  is_beside_latest_ = true;
}

// The boundary near the point r is { x : n.x - h = -1/2 y A^-1 y }, where y is the tangential part of x - r and A the Hessian of h.
EntrySearch::Step EntrySearch::paraboloid_step() const {
  Step step;
  const bool from_beside = is_beside_latest_ || !has_best_;
  if (!gap_.has_hessian() && !has_best_) return step;
  const Sample& from = from_beside ? beside_ : best_;
  const GapJet& jet = from.jet;
  const LocalModel local = gap_.has_hessian() ? LocalModel::of(gap_, jet) : LocalModel::of(gap_, jet, secant_.matrix());
  const Symmetric2 A = local.A1 + local.A2;
  if (!is_curved(A)) return step;
  const Vector3 d = distance_at(from);
  const Vector2 y = local.plane1.project(d);
  const Vector2 y_rate = local.plane1.project(v_);
  const Vector2 u = A.solve(y);
  const Vector2 u_rate = A.solve(y_rate);
  if (!is_in_range(u) || !is_in_range(u_rate) || y.dot(u) < 0) return step;
  // The height of the line above the paraboloid is a t^2 + 2 b t + c.
  const double a = 0.5 * y_rate.dot(u_rate);
  const double b = 0.5 * (y.dot(u_rate) + from.slope);
  const double c = 0.5 * y.dot(u) + (from_beside ? jet.s : 0);
  const double distance = first_root(a, b, c);
  if (!std::isfinite(distance)) return step;
  const Vector3 dn = local.plane1.lift(u + distance * u_rate);
  step.normal = gap_.has_hessian() ? gap_.shape1().advance_normal(jet.n, jet.jet1, dn) : Vector3(jet.n + dn);
  const double along = step.normal.dot(jet.n);
  step.is_usable = all_finite(step.normal) && step.normal.lpNorm<Eigen::Infinity>() < kLongestStep * along;
  if (from_beside || !step.is_usable) return step;
  const Vector3 change = step.normal / along - jet.n;
  step.is_deep = gap_.has_hessian() && b * b - a * c > kSureDepth * rule_.tolerance() * a;
  step.length = change.norm();
  step.gain = std::max({0.5 * y.dot(u), d.dot(change), 0.0});
  return step;
}

bool EntrySearch::add_point(const Vector3& d) {
  points_[static_cast<std::size_t>(point_count_++ % CuttingPlanes::kCapacity)] = d;
  return portal_.add(d);
}

// The vector from the boundary point to the point where its tangent plane meets the line.
Vector3 EntrySearch::distance_at(const Sample& sample) const { return sample.jet.d + sample.t * v_; }

// The model's estimate of the remaining error. It uses the expected gain and its ratio to the previous one.
double EntrySearch::expected_error(const Step& step) const {
  if (!gap_.has_hessian() || !std::isfinite(step.gain)) return kUnbounded;
  const bool has_history = std::isfinite(promised_gain_) && promised_gain_ > 0 && step.length < kAsymptoticStep;
  const double contraction = has_history ? std::min(step.gain / promised_gain_, kSlowestContraction) : kSlowestContraction;
  return kGainSafety / (1 - contraction) * step.gain;
}

double EntrySearch::boundary_error() const {
  if (!has_best_) return kUnbounded;
  const double error = std::min({distance_at(best_).norm(), portal_.upper_bound() - best_.t, model_error_, point_error_});
  return std::max(error, 0.0) + gap_.rounding();
}

// A good point does not end the search by itself: the line may miss the body although a point of the line is within the tolerance.
//
// The point may be good long before the normal is. One of them is enough: the point on a sharp edge, the normal on a flat face.
bool EntrySearch::has_settled(const Step& step) {
  if (rule_.forbids(boundary_error()) || (!is_deep_ && !portal_.is_pierced())) return false;
  const bool is_normal_good = rule_.allows(distance_at(best_).norm()) || step.length <= settings_.tolerance;
  const bool is_exhausted = was_tried_ && (!portal_.is_pierced() || idle_steps_ >= kMaxIdleSteps);
  return is_normal_good || is_exhausted || ++polishing_steps_ > kMaxPolishingSteps;
}

bool EntrySearch::is_worth_it(const Vector3& normal) const {
  const double slope = normal.dot(v_);
  if (slope >= -kGrazing * normal.norm()) return portal_.may_separate(normal - slope * v_);
  return !has_best_ || portal_.support_bound(normal) + slope * best_.t > -gap_.rounding() * normal.norm();
}

bool EntrySearch::choose(const Step& step, Vector3& normal) {
  const bool is_new = is_beside_latest_ || !was_tried_;
  const bool is_promising = step.is_usable && is_new && is_worth_it(step.normal);
  const bool is_slow =
      is_beside_latest_ ? slow_steps_ >= kMaxSlowSteps : idle_steps_ > 0 || step.gain > kGoodContraction * promised_gain_;
  const bool is_stuck = portal_.is_pierced() && (idle_steps_ >= kMaxIdleSteps || fruitless_steps_ >= kMaxFruitlessSteps);
  if (is_stuck) return false;
  if (is_promising && !is_slow) {
    promised_gain_ = step.gain;
  } else {
    promised_gain_ = kUnbounded;
    if (choose_by_portal(normal)) return true;
    if (!is_promising) return false;
  }
  was_tried_ = !is_beside_latest_;
  normal = step.normal;
  return true;
}

bool EntrySearch::choose_by_portal(Vector3& normal) {
  if (!portal_.is_pierced()) {
    slow_steps_ = 0;
    normal = tries_edge_ ? portal_.edge_normal() : portal_.bisector();
    tries_edge_ = !tries_edge_;
    return true;
  }
  const Vector3 across = has_best_ ? portal_.normal() : Vector3(-v_);
  const double length = across.norm();
  const double slope = across.dot(v_);
  const bool is_usable =
      slope < -kGrazing * length && (portal_.upper_bound() - best_.t) * -slope > kPortalRounding * gap_.rounding() * length;
  const bool by_points = !is_usable || idle_steps_ % 2 == 1;
  if (by_points && choose_by_points(normal)) return true;
  normal = across;
  return is_usable;
}

// The stored points and their hull lie in the body. The chosen normal is the direction in which the hull is farthest from best_. If
// the line passes through an edge of the portal, the portal may not find it.
bool EntrySearch::choose_by_points(Vector3& normal) {
  CuttingPlanes cuts;
  for (int k = 0; k < std::min(point_count_, CuttingPlanes::kCapacity); ++k) {
    cuts.add(points_[static_cast<std::size_t>(k)] + best_.t * v_);
  }
  const TangentPlane plane(best_.jet.n, best_.jet.n.unitOrthogonal());
  const CuttingPlanes::Maximum top = cuts.maximize(plane, kLargestTilt);
  if (top.is_interior) point_error_ = std::max(top.value, 0.0) + top.uncertainty;
  normal = best_.jet.n + plane.lift(top.u);
  return top.value > gap_.rounding() && normal.dot(v_) < -kGrazing * normal.norm();
}

EntrySearch::Result EntrySearch::found(Status status) const {
  const double error = boundary_error();
  // The line enters the body between the best plane and the portal. If the line only grazes the body, rounding may put the plane
  // behind the portal.
  const double t = std::fmin(best_.t, portal_.upper_bound());
  const double length = portal_.upper_bound() - t;
  // The portal is in the body, and the body lies behind every plane beside the line. If such a plane is this near, the line grazes
  // the body at the portal.
  const double grazing_error = -nearest_ + gap_.rounding();
  if (rule_.forbids(error) && portal_.is_pierced() && rule_.allows(grazing_error)) {
    return {Kind::Found, Status::Converged, portal_.upper_bound(), grazing_error, length, nearest_normal_};
  }
  if (has_best_) {
    // If the line only grazes the body, its slope does not grow behind the plane. The remaining sideways error then does not bound
    // the error of t.
    const double steep_length = is_deep_ ? error / -best_.slope : kUnbounded;
    const double t_error = std::fmin(steep_length, length + gap_.rounding() / -best_.slope);
    return {Kind::Found, status, t, error, t_error, best_.jet.n};
  }
  // The limit of evaluations is reached.
  if (portal_.is_pierced()) return {Kind::Found, status, portal_.upper_bound(), kUnbounded, kUnbounded, nearest_normal_};
  return {Kind::Miss, status, 0, kUnbounded, kUnbounded, nearest_normal_};
}

}  // namespace supernormal
