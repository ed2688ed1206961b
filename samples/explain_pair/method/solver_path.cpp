#include "method/solver_path.hpp"

#include <algorithm>
#include <limits>
#include <supernormal/proximity/solve.hpp>

#include "method/recording_shape.hpp"

namespace explain_pair {
namespace {

using supernormal::Order;
using supernormal::Proximity;
using supernormal::Settings;
using supernormal::Solver;

// Up to kAllIntervals evaluations each has its interval. Beyond, the spacing is this fraction of their number, because each
// interval takes a query.
constexpr int kAllIntervals = 24;
constexpr int kShareOfGaps = 8;

Proximity solve(const Pair& pair, const Shape& shape1, const Settings& settings) {
  return supernormal::find_proximity(shape1, pair.body1.pose, *pair.body2.shape, pair.body2.pose, settings,
                                     pair.first_normal ? &*pair.first_normal : nullptr);
}

std::vector<ProvedInterval> intervals_of(const Pair& pair, Settings settings, int evaluations) {
  std::vector<ProvedInterval> intervals;
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  for (int k = 1; intervals.empty() || intervals.back().evaluations < evaluations; k += k < kAllIntervals ? 1 : k / kShareOfGaps) {
    settings.max_evaluations = std::min(k, evaluations);
    const Proximity so_far = solve(pair, *pair.body1.shape, settings);
    lower = std::max(lower, so_far.gap);
    upper = std::min(upper, so_far.gap + so_far.global_error);
    intervals.push_back({settings.max_evaluations, lower, upper});
  }
  return intervals;
}

}  // namespace

double WorldGap::s(const Vector3& n) {
  gap_.evaluate(rotation_.transpose() * n, Order::Value, jet_);
  return jet_.s;
}

Evaluation WorldGap::evaluate_in_body1(const Vector3& n) {
  gap_.evaluate(n, Order::Point, jet_);
  return {rotation_ * n, jet_.s, rotation_ * (jet_.d + gap_.rolling_radius() * n)};
}

const char* name_of(Solver solver) {
  return solver == Solver::Hybrid ? "hybrid" : solver == Solver::Newton ? "Newton (I)" : "fixed point (II)";
}

bool is_solver_for(Solver solver, const Pair& pair) {
  const Shape &shape1 = *pair.body1.shape, &shape2 = *pair.body2.shape;
  if (solver == Solver::Hybrid) return true;
  if (shape1.traits().has_nonsmooth_points || shape2.traits().has_nonsmooth_points) return false;
  return solver == Solver::FixedPoint || (shape1.traits().has_hessian && shape2.traits().has_hessian);
}

SolverPath solver_path(const Pair& pair, const Settings& settings) {
  std::vector<Vector3> normals;
  const RecordingShape shape1(*pair.body1.shape, normals);
  SolverPath path{name_of(settings.solver), settings.solver, solve(pair, shape1, settings), {}, {}};
  WorldGap gap(pair);
  for (const Vector3& n : normals) path.evaluations.push_back(gap.evaluate_in_body1(n));
  path.intervals = intervals_of(pair, settings, path.answer.evaluations);
  return path;
}

}  // namespace explain_pair
