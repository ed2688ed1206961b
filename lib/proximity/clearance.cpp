#include "supernormal/proximity/clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/usable_pose.hpp"
#include "base/validation.hpp"
#include "proximity/gap/limits.hpp"
#include "proximity/local/first_guess.hpp"
#include "proximity/local/regular_hessian.hpp"
#include "proximity/search/answer.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal {
namespace {

constexpr int kMostEvaluations = 3;

double require_distance(double distance) {
  if (!std::isfinite(distance)) throw std::invalid_argument("distance is " + std::to_string(distance) + " m; it must be finite");
  return distance;
}

/// The bounds of one pair.
class Bounds {
 public:
  /// What the search is for. For a bound it goes on even when the gap is proved not to be above `enough`.
  enum class Aim { Verdict, Bound };

  /// The poses are usable.
  Bounds(const ProximityQuery& pair, Aim aim) : gap_(*pair.shape1, *pair.pose1, *pair.shape2, *pair.pose2), aim_(aim) {}

  /// Searches until the lower bound is above `enough`, or until it is proved that it cannot be, or the evaluations are used up.
  void run(double enough, int max_evaluations, const Vector3* first_normal);

  const Clearance& best() const { return best_; }
  bool is_below() const { return upper_ <= enough_; }  ///< whether it is proved that the gap is not above `enough`

 private:
  bool take_spheres();
  bool have_common_point() const;
  bool evaluate(const Vector3& n, Order order);
  Vector3 next_normal(Order order) const;

  GapFunction gap_;
  const Aim aim_;
  Clearance best_;
  GapJet jet_;
  double enough_ = 0, upper_ = std::numeric_limits<double>::infinity();
};

/// The bodies are inside the spheres of their bounding radii about the origins of their frames.
bool Bounds::take_spheres() {
  const double distance = gap_.offset().norm();
  if (!(distance > 0)) return false;
  best_.lower_bound = distance - gap_.shape1().bounding_radius() - gap_.shape2().bounding_radius() - gap_.rounding();
  best_.normal = gap_.offset() / distance;
  return best_.lower_bound > enough_;
}

/// Bodies with a common point are not apart. Near the maximum of an overlap each witness point is inside the other body, and so is
/// the point between them.
bool Bounds::have_common_point() const {
  const Vector3 point = jet_.jet1.r + 0.5 * jet_.d;
  return gap_.shape1().surely_contains(point) &&
         gap_.shape2().surely_contains(gap_.rotation().transpose() * (point - gap_.offset()));
}

/// Returns whether the search goes on.
bool Bounds::evaluate(const Vector3& n, Order order) {
  gap_.evaluate(n, order, jet_);
  best_.evaluations = gap_.evaluations();
  if (!jet_.is_finite()) {
    best_.lower_bound = -std::numeric_limits<double>::infinity();
    return false;
  }
  const double bound = jet_.s - gap_.rounding();
  if (bound > best_.lower_bound) {
    best_.lower_bound = bound;
    best_.normal = n;
  }
  if (best_.lower_bound > enough_) return false;
  if (aim_ == Aim::Bound) return true;
  // Lemma 1: s(m) <= |d + rho n| - rho for every normal m. The common point takes 0.7 times the instructions of an
  // evaluation, so it comes last.
  upper_ = std::min(upper_, jet_.s + optimality_gap_bound(jet_, gap_.rolling_radius()) + gap_.rounding());
  if (upper_ > enough_ && jet_.s < 0 && have_common_point()) upper_ = std::min(upper_, 0.0);
  return upper_ > enough_;
}

/// Newton's step, or the direction of the cut, as in GJK.
Vector3 Bounds::next_normal(Order order) const {
  const Vector3 cut = jet_.d + gap_.rolling_radius() * jet_.n;
  if (order == Order::Hessian) {
    const RegularHessian hessian(gap_.curvature(jet_), jet_.s, jet_.n, gap_.length_unit(), limits::kFlattest);
    if (hessian.is_regular()) {
      const Vector3 step = hessian.solve(jet_.d - jet_.s * jet_.n);
      if (step.squaredNorm() <= 1) return (jet_.n + step).normalized();
    }
  }
  const double length = cut.norm();
  return length > 0 ? Vector3(cut / length) : jet_.n;
}

void Bounds::run(double enough, int max_evaluations, const Vector3* first_normal) {
  enough_ = enough;
  if (!gap_.is_finite() || take_spheres()) return;
  const bool is_warm = first_normal != nullptr && is_usable(*first_normal);
  Vector3 n = is_warm ? Vector3(first_normal->normalized()) : first_guess(gap_);
  // Most queries end with the first evaluation, which takes no Hessian unless there may be another.
  const Order order = gap_.has_hessian() && max_evaluations > 1 ? Order::Hessian : Order::Point;
  while (evaluate(n, order) && gap_.evaluations() < max_evaluations) n = next_normal(order);
}

}  // namespace

Clearance find_clearance(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, double enough,
                         int max_evaluations, const Vector3* first_normal) {
  require_in("max_evaluations", max_evaluations, 1, kMostEvaluations);
  if (std::isnan(enough)) throw std::invalid_argument("enough is NaN; it must be a number");
  if (!is_usable(pose1) || !is_usable(pose2)) return {};
  Bounds bounds({&shape1, &pose1, &shape2, &pose2}, Bounds::Aim::Bound);
  bounds.run(enough, max_evaluations, first_normal);
  return bounds.best();
}

namespace {

/// What the bounds of a pair say.
enum class Verdict { Farther, NotFarther, Open };

Verdict decide_by_bounds(const ProximityQuery& pair, double distance, Clearance& out) {
  out = {};
  if (!has_usable_poses(pair)) return Verdict::NotFarther;
  Bounds bounds(pair, Bounds::Aim::Verdict);
  bounds.run(distance, kMostEvaluations, pair.first_normal);
  out = bounds.best();
  if (out.lower_bound > distance) return Verdict::Farther;
  return bounds.is_below() || out.evaluations == 0 ? Verdict::NotFarther : Verdict::Open;
}

/// The query that answers an open pair. Apart, every start leads to the same maximum. In an overlap the query without a start looks
/// for the highest.
ProximityQuery open_query(ProximityQuery pair, double distance, const Clearance& out) {
  pair.first_normal = distance >= 0 ? &out.normal : nullptr;
  pair.poses_are_usable = true;
  return pair;
}

bool decide_by_answer(const ProximityQuery& pair, double distance, const Proximity& answer, Clearance& out) {
  if (answer.status == Status::InvalidInput) return false;
  out.evaluations += answer.evaluations;
  const double bound = answer.gap - GapFunction(*pair.shape1, *pair.pose1, *pair.shape2, *pair.pose2).rounding();
  if (bound > out.lower_bound) {
    out.lower_bound = bound;
    out.normal = (pair.pose1->rotation.transpose() * answer.normal).normalized();
  }
  return out.lower_bound > distance;
}

}  // namespace

bool is_farther_than(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, double distance,
                     Vector3* normal, int* evaluations) {
  require_distance(distance);
  const bool is_warm = normal != nullptr && is_usable(*normal);
  Clearance out;
  const ProximityQuery pair = {&shape1, &pose1, &shape2, &pose2, is_warm ? normal : nullptr};
  const Verdict verdict = decide_by_bounds(pair, distance, out);
  const bool is_farther = verdict == Verdict::Open
                              ? decide_by_answer(pair, distance, find_proximity(open_query(pair, distance, out)), out)
                              : verdict == Verdict::Farther;
  if (normal != nullptr) *normal = out.normal;
  if (evaluations != nullptr) *evaluations = out.evaluations;
  return is_farther;
}

std::size_t are_farther_than(std::span<const ProximityQuery> queries, double distance, std::span<Clearance> results,
                             std::span<bool> is_farther) {
  require_distance(distance);
  require_one_for_each("results", results.size(), queries.size());
  require_one_for_each("is_farther", is_farther.size(), queries.size());
  // The bounds leave few pairs open. These are asked together.
  constexpr std::size_t kAtOnce = 32;
  std::array<ProximityQuery, kAtOnce> open{};
  std::array<std::size_t, kAtOnce> which{};
  std::array<Proximity, kAtOnce> answers;
  std::size_t size = 0, count = 0;
  const auto answer_open = [&] {
    find_proximities({open.data(), size}, {}, {answers.data(), size});
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t k = which[i];
      is_farther[k] = decide_by_answer(queries[k], distance, answers[i], results[k]);
      count += is_farther[k];
    }
    size = 0;
  };
  for (std::size_t k = 0; k < queries.size(); ++k) {
    const Verdict verdict = decide_by_bounds(queries[k], distance, results[k]);
    is_farther[k] = verdict == Verdict::Farther;
    count += is_farther[k];
    if (verdict != Verdict::Open) continue;
    open[size] = open_query(queries[k], distance, results[k]);
    which[size] = k;
    if (++size == kAtOnce) answer_open();
  }
  if (size > 0) answer_open();
  return count;
}

}  // namespace supernormal
