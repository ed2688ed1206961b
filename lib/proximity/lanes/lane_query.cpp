#include "proximity/lanes/lane_query.hpp"

#include <algorithm>
#include <array>

#include "proximity/gap/tuning.hpp"
#include "proximity/search/answer.hpp"
#include "proximity/search/solvers.hpp"
#include "shapes/lanes/lane_body_of.hpp"

namespace supernormal {
namespace {

LanePair lane_pair(const ProximityQuery& pair) {
  const Vector3* const first = pair.first_normal;
  return {LaneBodies::of(*pair.shape1),
          LaneBodies::of(*pair.shape2),
          pair.pose1->position.data(),
          pair.pose1->rotation.data(),
          pair.pose2->position.data(),
          pair.pose2->rotation.data(),
          first != nullptr ? first->data() : nullptr};
}

bool is_of_ellipsoids(const LanePair& pair) {
  return pair.body1 != nullptr && pair.body1->is_ellipsoid && pair.body2 != nullptr && pair.body2->is_ellipsoid;
}

bool is_ball(const LaneBody& body) { return body.rolling_radius == body.bounding_radius; }

bool are_balls(const LanePair& pair) { return is_ball(*pair.body1) && is_ball(*pair.body2); }

Proximity find_between_balls(const ProximityQuery& query, const LanePair& pair, const Settings& settings) {
  return find_between_balls(query, pair.body1->bounding_radius, pair.body2->bounding_radius, settings);
}

LaneSettings lane_settings(const Settings& settings, bool wants_curvature) {
  return {settings.tolerance,
          std::min({kMostLaneEvaluations, kTuning.newton_evaluations, settings.max_evaluations}),
          settings.max_evaluations,
          settings.stop_when_apart,
          settings.certify_depth ? 0 : kTuning.unsearched_depth,
          settings.certify_depth ? 0 : kTuning.depth_per_radius,
          wants_curvature};
}

Vector3 vector_of(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

/// Proved, followed or apart: what answer() says of it.
Proximity complete_answer(const LaneAnswer& lane) {
  Proximity out;
  out.gap = lane.gap;
  out.error = (lane.is_followed ? std::min(lane.error, lane.tolerance) : lane.error) + lane.rounding;
  out.normal = vector_of(lane.normal);
  out.point1 = vector_of(lane.point1);
  out.point2 = vector_of(lane.point2);
  out.contact = vector_of(lane.contact);
  out.evaluations = lane.evaluations;
  out.status = lane.outcome == LaneOutcome::Apart ? Status::Apart : Status::Converged;
  out.is_global = !lane.is_followed || 2 * lane.gap >= -lane.tolerance;
  out.global_error = out.is_global ? std::max(out.error, lane.tolerance + lane.rounding) : lane.error + lane.rounding;
  return out;
}

Matrix3 matrix_of(const double* numbers) {
  Matrix3 out;
  out << numbers[0], numbers[3], numbers[4], numbers[3], numbers[1], numbers[5], numbers[4], numbers[5], numbers[2];
  return out;
}

/// The evaluation at which the lanes ended.
GapJet last_jet(GapFunction& gap, const LaneAnswer& lane, bool has_jet) {
  GapJet jet;
  if (!has_jet) {
    gap.evaluate(vector_of(lane.normal), Order::Hessian, jet);
    return jet;
  }
  const double* const found = lane.jet;
  jet.n = vector_of(found + kFoundNormal);
  jet.s = found[kFoundS];
  jet.d = vector_of(found + kFoundD);
  jet.m = -(gap.rotation().transpose() * jet.n);
  jet.jet1 = {found[kFoundH], vector_of(found + kFoundR), matrix_of(found + kFoundHessian1)};
  jet.jet2 = {found[kFoundH2], vector_of(found + kFoundR2), matrix_of(found + kFoundHessian2)};
  return jet;
}

/// What the lanes leave: the search, or the contact.
Proximity finish_alone(const ProximityQuery& pair, const Settings& settings, const LaneAnswer& lane) {
  GapFunction gap(*pair.shape1, *pair.pose1, *pair.shape2, *pair.pose2);
  // Lanes of ellipsoids keep no jet. Its evaluation counts, unless the limit leaves none.
  const bool has_jet = !is_of_ellipsoids(lane_pair(pair));
  gap.count_earlier(has_jet ? lane.evaluations : std::min(lane.evaluations, settings.max_evaluations - 1));
  const GapJet jet = last_jet(gap, lane, has_jet);
  if (lane.outcome == LaneOutcome::Open) {
    std::array<Vector3, kMostLaneRounds> cuts;
    const auto count = static_cast<std::size_t>(lane.evaluations - 1);
    for (std::size_t k = 0; k < count; ++k) cuts[k] = vector_of(lane.cuts[k]);
    return resume_hybrid(gap, settings, jet, {cuts.data(), count},
                         pair.first_normal != nullptr ? WantedMaximum::Tracked : WantedMaximum::Highest);
  }
  const StoppingRule rule(gap, settings);
  Proximity out = answer(gap, rule, jet, lane.error, Status::Converged);
  place_contact(gap, rule, jet, out);
  return out;
}

Proximity answer_of(const ProximityQuery& pair, const Settings& settings, const LaneAnswer& lane) {
  if (lane.outcome == LaneOutcome::Proved || lane.outcome == LaneOutcome::Apart) return complete_answer(lane);
  return in_world(finish_alone(pair, settings, lane), *pair.pose1);
}

}  // namespace

bool is_for_lanes(const Shape& shape1, const Shape& shape2, const Settings& settings) {
  return settings.solver == Solver::Hybrid && LaneBodies::of(shape1) != nullptr && LaneBodies::of(shape2) != nullptr;
}

Proximity find_in_one_lane(const ProximityQuery& pair, const Settings& settings) {
  const LanePair input = lane_pair(pair);
  if (are_balls(input)) return find_between_balls(pair, input, settings);
  LaneAnswer lane;
  kOneLane.query(&input, 1, is_of_ellipsoids(input), lane_settings(settings, false), &lane);
  return answer_of(pair, settings, lane);
}

void LaneBatch::add(const ProximityQuery& query, std::size_t index) {
  const LanePair pair = lane_pair(query);
  if (are_balls(pair)) {
    results_[index] = find_between_balls(query, pair, settings_);
    if (!curvatures_.empty()) curvatures_[index] = {kUnknownCurvature, kUnknownCurvature};
    return;
  }
  Group& group = groups_[is_of_ellipsoids(pair) ? 0 : 1];
  group.pairs[group.count] = pair;
  group.queries[group.count] = query;
  group.indices[group.count] = index;
  if (++group.count == kAtOnce) solve(group);
}

void LaneBatch::solve(Group& group) {
  std::array<LaneAnswer, kAtOnce> answers;
  kernel_.query(group.pairs.data(), static_cast<int>(group.count), &group == groups_.data(),
                lane_settings(settings_, !curvatures_.empty()), answers.data());
  for (std::size_t k = 0; k < group.count; ++k) {
    const std::size_t index = group.indices[k];
    results_[index] = answer_of(group.queries[k], settings_, answers[k]);
    if (!curvatures_.empty()) curvatures_[index] = {answers[k].curvature[0], answers[k].curvature[1]};
  }
  group.count = 0;
}

void LaneBatch::solve_rest() {
  for (Group& group : groups_) {
    if (group.count > 0) solve(group);
  }
}

}  // namespace supernormal
