#include "supernormal/impact/time_of_impact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/usable_pose.hpp"
#include "base/validation.hpp"
#include "impact/moving_gap.hpp"
#include "proximity/gap/usable_settings.hpp"
#include "supernormal/impact/mesh_time_of_impact.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal {
namespace {

// A gap below this multiple of its rounding error cannot be distinguished from an overlap.
constexpr double kRoundingUnits = 4;

// Rounding grows with the displacement of the bodies, so the horizon is searched in windows. Each is this many times as long as all
// before. The rounding error of an impact is thus at most the error at this multiple of the displacement until then.
constexpr double kWindowGrowth = 8;

// The first window ends where rounding is this fraction of the tolerance, or twice the rounding of the initial positions.
constexpr double kUnfelt = 1e-3;

// A query at the end of a stride may find an overlap. Its depth is not needed. Such a query gets the evaluations of separate
// bodies.
constexpr int kLookAheadEvaluations = 12;

// rad; normals farther apart prove nothing about the time between them.
constexpr double kWidestRotation = 2;

// Displacement after which bodies that touch at first are tested again, in tolerances: enough to find them separate.
constexpr double kPartingDistance = 64;

// An impact is near if a stride would leave less than this fraction of the gap.
constexpr double kFarShare = 0.3;

// A normal is kept while it proves at least this fraction of the gap at which it was found.
constexpr double kGoodShare = 0.5;

// A normal that proves less than this fraction of its stride ends the present method. The next stride changes from a fixed normal
// to a rotating one, or back.
constexpr double kPoorShare = 0.25;

// Far from an impact, gaps are computed to this fraction of the last gap.
constexpr double kRough = 0.05;

/// The longest interval, at most `left`, in which the bound of theory.md with this K stays positive, s. Assumes a linear gap with
/// the value a and the slope `rate` at the start.
double longest_stride(double a, double rate, double K, double left) {
  const double to_zero = -rate * left > a ? a / -rate : left;
  if (K * to_zero * to_zero <= 2 * a) return to_zero;
  return std::min(2 / K * (rate + std::sqrt(2 * K * a)), left);
}

/// The first fraction of the unit interval in which a (1 - x) + b x - k x (1 - x) is positive, for a > 0.
double positive_share(double a, double b, double k) {
  // The first root of a - p x + k x^2.
  const double p = a - b + k;
  const double discriminant = p * p - 4 * k * a;
  if (p <= 0 || discriminant < 0) return 1;
  return std::min(2 * a / (p + std::sqrt(discriminant)), 1.0);
}

/// The minimum of the same function in the interval.
double least_value(double a, double b, double k) {
  const double p = a - b + k;
  if (p <= 0) return a;
  return p >= 2 * k ? b : a - 0.25 * p * p / k;
}

/// The rotation of a unit normal along a great circle, from one time to a later one.
struct NormalRotation {
  double angle;  // rad
  Vector3 axis;

  static NormalRotation between(const Vector3& from, const Vector3& to) {
    const Vector3 across = from.cross(to);
    const double sine = across.norm();
    return {std::atan2(sine, from.dot(to)), sine > 0 ? Vector3(across / sine) : from.unitOrthogonal()};
  }

  Vector3 rotated(const Vector3& n, double share) const {
    return (std::cos(share * angle) * n + std::sin(share * angle) * axis.cross(n)).normalized();
  }
};

class ImpactSearch {
 public:
  ImpactSearch(MovingGap& gap, double horizon, const Settings& settings)
      : gap_(gap),
        horizon_(horizon),
        most_evaluations_(settings.max_evaluations),
        asked_(0.5 * settings.tolerance * gap.length_unit()) {
    look_until(gap.known_until(std::max(kUnfelt * asked_, 2 * gap.rounding(0)), horizon));
  }

  /// Precondition: the bodies are separate before `start`.
  Impact run(double start, const Vector3* first_normal) {
    while (end_ < start) look_farther();
    t_ = start;
    now_ = find(t_, first_normal);
    if (t_ == 0 && now_.status != Status::InvalidInput && now_.gap <= tolerance_) {
      if (now_.gap < -tolerance_) return end(ImpactStatus::Overlapping);
      if (!part()) return end(ImpactStatus::Hits);
    }
    while (now_.status != Status::InvalidInput && !is_impact()) {
      if (t_ == horizon_) return end(ImpactStatus::Apart);
      if (++strides_ > most_evaluations_) return end(ImpactStatus::NotConverged);
      if (t_ == end_) {
        if (gap_.is_parting(t_)) return apart(gap_.parting_normal(horizon_));
        look_farther();
      } else {
        advance();
      }
    }
    return end(ImpactStatus::Hits);
  }

  /// The result if the bodies are separate until the horizon, where `n` separates them.
  Impact apart(const Vector3& n) {
    t_ = horizon_;
    now_ = gap_.evaluate(n, t_);
    return end(ImpactStatus::Apart);
  }

 private:
  Impact end(ImpactStatus status) const {
    Impact out;
    out.evaluations = gap_.evaluations();
    if (now_.status == Status::InvalidInput) return out;
    out.status = is_known(status) ? status : ImpactStatus::NotConverged;
    out.time = out.apart_until = t_;
    out.proximity = now_;
    const Vector3 origin = gap_.origin(t_);
    for (Vector3* point : {&out.proximity.point1, &out.proximity.point2, &out.proximity.contact}) *point += origin;
    return out;
  }

  void look_until(double end) {
    end_ = end;
    rounding_ = gap_.rounding(end);
    tolerance_ = std::max(asked_, kRoundingUnits * rounding_);
  }

  void look_farther() { look_until(std::min(kWindowGrowth * end_, horizon_)); }

  /// Whether the gap is within the tolerance. A normal that need not be a common normal gives a lower bound of the gap alone: then
  /// a query finds the gap.
  bool is_impact() {
    if (now_.gap <= tolerance_ && now_.status == Status::Apart) now_ = find(t_, &now_.normal);
    return now_.gap <= tolerance_;
  }

  bool is_known(ImpactStatus status) const {
    if (now_.status == Status::Converged || now_.is_global) return true;
    return status == ImpactStatus::Apart || (status == ImpactStatus::Overlapping && now_.gap + now_.global_error < 0);
  }

  Proximity find(double t, const Vector3* first_normal) { return gap_.find(t, first_normal, tolerance_, most_evaluations_); }

  /// Advances as far as the bodies are proved separate.
  void advance() {
    const double left = end_ - t_;
    const double a = now_.gap - rounding_;
    const double rate = gap_.rate(now_, t_);
    if (!gap_.is_rotating()) return advance_straight(a, rate, left);
    if (a >= gap_.fastest() * left) return move_to(end_, gap_.evaluate(now_.normal, end_));
    const double as_balls = time_as_balls(left);
    if (as_balls == left) return move_to(end_, gap_.evaluate(now_.normal, end_));
    const double K = gap_.bound(now_.normal, 0, is_rotating_ ? rotation_.angle : 0);
    const double stride = longest_stride(a, rate, K, left);
    if (as_balls > stride) {
      t_ = std::min(t_ + as_balls, end_);
      now_ = find(t_, &now_.normal);
      return;
    }
    const double next = stride == left ? end_ : t_ + stride;
    const bool is_meeting = a + rate * stride < kFarShare * a;
    if (!is_meeting && !is_rotating_) return advance_fixed(a, next, stride);
    look_ahead(a, next, stride);
  }

  /// How long, at most `left`, the normal of now_ separates the balls about rotating bodies, s; 0 if it does not.
  double time_as_balls(double left) const {
    const double a = gap_.gap_of_balls(now_, t_) - rounding_;
    const double rate = now_.normal.dot(gap_.velocity());
    if (!(a > 0)) return 0;
    return -rate * left > a ? a / -rate : left;
  }

  /// Tries the normal of now_ for a whole stride. Far from an impact any normal near the best one will do.
  void advance_fixed(double a, double next, double stride) {
    const Proximity there = gap_.evaluate(now_.normal, next);
    const bool is_valid = there.status != Status::InvalidInput;
    const double share = is_valid ? proved_share(a, there, stride) : 1;
    if (share == 1 && (!is_valid || next == end_)) return move_to(end_, there);
    if (share == 1 && there.gap > kGoodShare * now_.gap) return move_to(next, there);
    is_rotating_ = share < kPoorShare;
    t_ = share == 1 ? next : std::min(t_ + share * stride, next);
    const double rough = kRough * now_.gap;
    const Vector3 normal = now_.normal;
    now_ = gap_.find(t_, &normal, rough, most_evaluations_);
    if (now_.status == Status::InvalidInput || now_.gap > 2 * rough) return;
    now_ = find(t_, &normal);
  }

  /// Finds the gap at the end of a stride, and the rotation of the normal until then.
  void look_ahead(double a, double next, double stride) {
    const Vector3 guess = NormalRotation{rotation_.angle * stride, rotation_.axis}.rotated(now_.normal, 1);
    const Proximity there = gap_.find(next, &guess, tolerance_, std::min(kLookAheadEvaluations, most_evaluations_));
    if (there.status == Status::InvalidInput) return move_to(next, there);
    const double share = proved_share(a, there, stride);
    is_rotating_ = share > kPoorShare;
    const NormalRotation rotation = NormalRotation::between(now_.normal, there.normal);
    rotation_ = {rotation.angle / stride, rotation.axis};
    if (share == 1 && (there.gap > tolerance_ || there.status == Status::Converged)) return move_to(next, there);
    const Vector3 between = rotation.rotated(now_.normal, share);
    t_ = std::min(t_ + share * stride, next);
    now_ = find(t_, &between);
  }

  /// Without rotation, s at a fixed normal is linear in time.
  void advance_straight(double a, double rate, double left) {
    if (-rate * left < a) return move_to(end_, gap_.evaluate(now_.normal, end_));
    t_ = std::min(t_ + a / -rate, end_);
    now_ = find(t_, &now_.normal);
  }

  void move_to(double t, const Proximity& proximity) {
    t_ = t;
    now_ = proximity;
  }

  /// The fraction of a stride in which the normals from now_ to `there` prove the bodies separate.
  double proved_share(double a, const Proximity& there, double stride) const {
    const double angle = NormalRotation::between(now_.normal, there.normal).angle;
    if (angle > kWidestRotation) return positive_share(a, a - gap_.fastest() * stride, 0);
    const double k = 0.5 * stride * stride * gap_.bound(now_.normal, angle, angle / stride) / std::cos(0.5 * angle);
    double b = there.gap - rounding_;
    if (b < 0 && angle > 0) b *= angle / std::sin(angle);
    return positive_share(a, b, k);
  }

  /// Whether bodies that touch at first separate. If so, now_ and t_ become a separate state.
  bool part() {
    if (end_ == 0 || gap_.fastest() == 0) return false;
    const double rate = gap_.rate(now_, 0);
    if (rate > 0) {
      const double K = gap_.bound(now_.normal, 0, 0);
      const double then = K * end_ > rate ? rate / K : end_;
      if (is_parted(now_, gap_.evaluate(now_.normal, then), then)) return true;
    }
    // At a vertex or on a face, another normal or another point of the face may be decisive.
    const double then =
        kPartingDistance * tolerance_ < end_ * gap_.fastest() ? kPartingDistance * tolerance_ / gap_.fastest() : end_;
    const Proximity later = find(then, &now_.normal);
    return is_parted(gap_.evaluate(later.normal, 0), later, then);
  }

  /// Whether s at the later normal proves that the bodies are separate at the time `then`.
  bool is_parted(const Proximity& first, const Proximity& later, double then) {
    if (first.status == Status::InvalidInput || later.status == Status::InvalidInput || later.gap <= tolerance_) return false;
    const double k = 0.5 * gap_.bound(later.normal, 0, 0) * then * then;
    if (first.gap < -tolerance_ || least_value(first.gap, later.gap, k) < -2 * tolerance_) return false;
    move_to(then, later);
    return true;
  }

  MovingGap& gap_;
  const double horizon_;  // s
  const int most_evaluations_;
  const double asked_;    // m; half of the tolerance, as queries may use the other half
  double end_ = 0;        // s; end of the window
  double rounding_ = 0;   // m; at any time in the window
  double tolerance_ = 0;  // m; the tolerance, or what rounding allows
  double t_ = 0;          // s; the bodies are separate before
  Proximity now_;         // at t_
  int strides_ = 0;
  NormalRotation rotation_{0, Vector3::UnitX()};  // of the normal in a second, from the last look-ahead
  bool is_rotating_ = false;                      // whether the next stride rotates the normal
};

/// Throws std::invalid_argument if a number is out of range.
void require_usable(double horizon, const Settings& settings) {
  require_in("horizon", horizon, 0, kMaxHorizon, "s");
  require_in_range(settings);
}

/// Whether the numbers of a motion, and the angle of its rotation until the horizon, are in range.
bool is_usable(const Motion& motion, double horizon) {
  const bool is_in_range = all_within(motion.velocity, kMaxMotion) && all_within(motion.angular_velocity, kMaxMotion) &&
                           all_within(motion.centre, kMaxMotion) && all_within(motion.pose.position, kMaxMotion);
  return is_in_range && is_usable(motion.pose) && all_within(horizon * motion.angular_velocity, kMaxMotion);
}

/// A triangle about its middle, where the solvers of the gap start.
struct MovingTriangle {
  std::array<Vector3, 3> vertices;
  Motion motion;

  MovingTriangle(const MeshTriangle& triangle, const Motion& mesh_motion) : vertices(triangle.vertices), motion(mesh_motion) {
    const Vector3 middle = (vertices[0] + vertices[1] + vertices[2]) / 3;
    for (Vector3& vertex : vertices) vertex -= middle;
    motion.pose.position += motion.pose.rotation * middle;
    motion.centre -= middle;
  }
};

bool is_first(const Impact& one, const Impact& other) {
  if (one.may_hit() != other.may_hit()) return one.may_hit();
  return one.may_hit() ? one.time < other.time : one.proximity.gap < other.proximity.gap;
}

}  // namespace

Impact find_time_of_impact(const Shape& shape1, const Motion& motion1, const Shape& shape2, const Motion& motion2, double horizon,
                           const Settings& settings, const Vector3* first_normal) {
  require_usable(horizon, settings);
  if (!is_usable(motion1, horizon) || !is_usable(motion2, horizon)) return {};
  MovingPair pair(shape1, motion1, shape2, motion2, settings.solver);
  ImpactSearch search(pair, horizon, settings);
  const double start = pair.balls_meet(horizon);
  if (start > horizon) return search.apart(pair.parting_normal(horizon));
  Vector3 normal;
  if (first_normal != nullptr) normal = motion1.pose.rotation * *first_normal;
  return search.run(start, first_normal != nullptr ? &normal : nullptr);
}

Impact find_plane_time_of_impact(const Shape& shape, const Motion& motion, const Vector3& plane_normal, double plane_offset,
                                 double horizon, const Settings& settings) {
  require_usable(horizon, settings);
  require_unit("plane_normal", plane_normal);
  const bool is_plane_usable = all_finite(plane_normal) && std::islessequal(std::abs(plane_offset), kMaxMotion);
  if (!is_usable(motion, horizon) || !is_plane_usable) return {};
  MovingOverPlane gap(shape, motion, plane_normal, plane_offset);
  return ImpactSearch(gap, horizon, settings).run(0, nullptr);
}

MeshImpact find_mesh_time_of_impact(const Shape& shape, const Motion& motion, std::span<const MeshTriangle> triangles,
                                    const Motion& mesh_motion, double horizon, const Settings& settings) {
  require_usable(horizon, settings);
  if (!is_usable(motion, horizon) || !is_usable(mesh_motion, horizon)) return {};
  MeshImpact first;
  first.impact.status = ImpactStatus::Apart;
  first.impact.time = first.impact.apart_until = horizon;
  int evaluations = 0;
  bool is_empty = true;
  for (const MeshTriangle& triangle : triangles) {
    const MovingTriangle moving(triangle, mesh_motion);
    const Impact impact = find_time_of_impact(shape, motion, Polytope(moving.vertices), moving.motion, first.impact.time, settings);
    if (impact.status == ImpactStatus::InvalidInput) return {};
    evaluations += impact.evaluations;
    if (is_empty || is_first(impact, first.impact)) first = {impact, impact.may_hit() ? triangle.index : -1};
    is_empty = false;
  }
  first.impact.evaluations = evaluations;
  return first;
}

}  // namespace supernormal
