#include "supernormal/proximity/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "proximity/answer.hpp"
#include "proximity/limits.hpp"
#include "proximity/local/first_guess.hpp"
#include "proximity/local/regular_hessian.hpp"
#include "proximity/usable_pose.hpp"
#include "shapes/validation.hpp"
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
  /// The poses are usable.
  Bounds(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2) : gap_(shape1, pose1, shape2, pose2) {}

  /// Searches until a bound decides whether the gap is above `enough`, or the evaluations are used up.
  void run(double enough, int max_evaluations, const Vector3* first_normal);

  const Clearance& best() const { return best_; }
  bool is_below() const { return upper_ <= enough_; }  ///< whether it is proved that the gap is not above `enough`

 private:
  bool take_spheres();
  bool evaluate(const Vector3& n, Order order);
  Vector3 next_normal(Order order) const;

  GapFunction gap_;
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

/// Returns whether the search goes on.
bool Bounds::evaluate(const Vector3& n, Order order) {
  gap_.evaluate(n, order, jet_);
  best_.evaluations = gap_.evaluations();
  if (!jet_.is_finite()) {
    best_.lower_bound = -std::numeric_limits<double>::infinity();
    return false;
  }
  const double bound = jet_.s - gap_.rounding();
  if (bound > best_.lower_bound || gap_.evaluations() == 1) {
    best_.lower_bound = std::max(bound, best_.lower_bound);
    best_.normal = n;
  }
  if (best_.lower_bound > enough_) return false;
  // Lemma 1: s(m) <= |d + rho n| - rho for every normal m.
  upper_ = std::min(upper_, jet_.s + optimality_gap_bound(jet_, gap_.rolling_radius()) + gap_.rounding());
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
  Bounds bounds(shape1, pose1, shape2, pose2);
  bounds.run(enough, max_evaluations, first_normal);
  return bounds.best();
}

namespace {

bool decide(const ProximityQuery& pair, double distance, Clearance& out) {
  out = {};
  if (!is_usable(*pair.pose1) || !is_usable(*pair.pose2)) return false;
  Bounds bounds(*pair.shape1, *pair.pose1, *pair.shape2, *pair.pose2);
  bounds.run(distance, kMostEvaluations, pair.first_normal);
  out = bounds.best();
  if (out.lower_bound > distance) return true;
  if (bounds.is_below() || out.evaluations == 0) return false;
  // Apart, every start leads to the same maximum. In an overlap the query without a start looks for the highest.
  ProximityQuery query = pair;
  query.first_normal = distance >= 0 ? &out.normal : nullptr;
  const Proximity answer = find_proximity(query);
  if (answer.status == Status::InvalidInput) return false;
  out.evaluations += answer.evaluations;
  if (answer.gap > out.lower_bound) {
    out.lower_bound = answer.gap;
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
  const bool is_farther = decide({&shape1, &pose1, &shape2, &pose2, is_warm ? normal : nullptr}, distance, out);
  if (normal != nullptr) *normal = out.normal;
  if (evaluations != nullptr) *evaluations = out.evaluations;
  return is_farther;
}

std::size_t are_farther_than(std::span<const ProximityQuery> queries, double distance, std::span<Clearance> results,
                             std::span<bool> is_farther) {
  require_distance(distance);
  require_one_for_each("results", results.size(), queries.size());
  require_one_for_each("is_farther", is_farther.size(), queries.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    is_farther[k] = decide(queries[k], distance, results[k]);
    count += is_farther[k];
  }
  return count;
}

}  // namespace supernormal
