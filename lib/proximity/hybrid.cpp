#include <algorithm>
#include <limits>

#include "proximity/answer.hpp"
#include "proximity/bounds/branch_and_bound.hpp"
#include "proximity/bounds/other_maxima.hpp"
#include "proximity/contact_point.hpp"
#include "proximity/local/ascent.hpp"
#include "proximity/local/certified_newton.hpp"
#include "proximity/local/first_guess.hpp"
#include "proximity/local/vertex_cache.hpp"
#include "proximity/solvers.hpp"

namespace supernormal {

namespace {

// A branch is followed without a look at others down to this depth, in units of the pair's length: between two steps of a
// simulation that does not let bodies sink into one another, no other branch can become much better.
constexpr double kFollowBranchDepth = 0.02;

// Without history the highest maximum is wanted: it is looked for until none can be higher by more than this share of the depth,
// and normals that come this near are climbed from.
constexpr double kHighestWidth = 0.01;
constexpr double kHighestNear = 0.06;

// But it takes so many evaluations only: fewer in shallow overlaps, which are common, least of smooth bodies; not before it is
// proved that the bodies overlap at all, though, which takes a few as a rule. Where all the ways out are of about the same length,
// as of concentric spheres, it would take hundreds to prove that.
constexpr double kShallowDepth = 0.15;  // of the pair's length
constexpr int kShallowEvaluations = 18;
constexpr int kShallowSharpEvaluations = 25;
constexpr int kManyEvaluations = 200;

// With history the branch is left when another is shallower by the second share, and not kept when one may be shallower by more
// than the first: so it does not flip between two, and is at most 1.5 times as deep as the best.
constexpr double kBranchWidth = 1.0 / 3;
constexpr double kBranchWorth = 1.0 / 6;

// A climb of more evaluations has met sharp edges, whatever the radii of curvature where it ended: other maxima are looked for.
constexpr int kEasyClimb = 12;

/// How thoroughly other maxima are looked for; not at all where no evaluation is allowed.
BranchAndBound::Goal search_goal(const GapFunction& gap, const Settings& settings, Branch branch, double tolerance, double depth) {
  const int limit = settings.max_evaluations;
  if (settings.certify_depth) return {tolerance, limit, limit, 0.5 * tolerance, 0};
  if (branch == Branch::OfStart && depth <= kFollowBranchDepth * gap.length_unit()) return {};
  const double radius1 = gap.shape1().min_curvature_radius_estimate(), radius2 = gap.shape2().min_curvature_radius_estimate();
  const bool may_have_tips = gap.shape1().rolling_radius() == 0 || gap.shape2().rolling_radius() == 0 || gap.shape2().has_kinks();
  const bool may_have_others = may_have_other_maxima(radius1, radius2, depth, gap.length_unit(), may_have_tips);
  const int most_for_overlap = std::min(limit, gap.evaluations() + kManyEvaluations);
  const double cutoff = branch == Branch::OfStart ? std::max(kBranchWorth * depth, tolerance) : tolerance;
  if (!may_have_others && gap.evaluations() <= kEasyClimb) {
    if (!may_have_tips) return {};
    // Of tips the radii are estimates: not that there are no others is proved then, but that the bodies overlap at all.
    return {depth, gap.evaluations(), most_for_overlap, cutoff, 0};
  }
  const bool is_sharp = gap.shape2().has_kinks() || radius1 + radius2 == 0;
  const bool is_shallow = depth < kShallowDepth * gap.length_unit();
  const int affordable = is_shallow ? (is_sharp ? kShallowSharpEvaluations : kShallowEvaluations) : kManyEvaluations;
  const int most = std::min(limit, gap.evaluations() + affordable);
  if (branch == Branch::OfStart) return {std::max(kBranchWidth * depth, tolerance), most, most_for_overlap, cutoff, 0};
  return {std::max(kHighestWidth * depth, tolerance), most, most_for_overlap, cutoff, kHighestNear * depth};
}

/// The answer after a search for higher maxima than `best`, in which that is put.
Proximity search(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const Settings& settings, const BranchAndBound::Goal& goal,
                 GapJet& best, Status status) {
  double error = ascent.error();
  BranchAndBound proof(gap, cuts, ascent, settings);
  const bool is_reached = proof.run(goal, best, error, status);
  if (!is_reached && gap.evaluations() >= settings.max_evaluations) status = Status::EvaluationLimit;
  const bool is_proved = is_reached && settings.certify_depth;
  if (is_proved) {
    error = proof.excess();
    status = Status::Converged;
  }
  Proximity out = answer(gap, settings, best, error, status);
  out.global_error = std::min(out.global_error, proof.excess() + gap.rounding());
  out.is_global = out.is_global || is_proved;
  return out;
}

/// Climbs from the start, a normal or what was evaluated there; if the bodies overlap so deeply against their sharpest edges that
/// there may be other maxima, looks for a higher one, but leaves the branch of an earlier pose only when it has stopped being
/// nearly the best.
template <typename Start>
Proximity climb_and_search(GapFunction& gap, const Settings& settings, CuttingPlanes& cuts, const Start& start, Branch branch) {
  const double tolerance = absolute_tolerance(gap, settings);
  Ascent ascent(gap, cuts, settings, tolerance);
  Status status = ascent.climb(start);
  GapJet best = ascent.best();
  Proximity out = answer(gap, settings, best, ascent.error(), status);
  if (!out.is_global && status != Status::InvalidInput) {
    const BranchAndBound::Goal goal = search_goal(gap, settings, branch, tolerance, -best.s);
    if (goal.max_evaluations > 0) out = search(gap, cuts, ascent, settings, goal, best, status);
  }
  out.contact = contact_point(gap, best);
  if (gap.shape2().has_kinks() && status != Status::InvalidInput) out.normal = VertexCache(gap).held_normal(best);
  return out;
}

}  // namespace

Proximity solve_hybrid(GapFunction& gap, const Settings& settings, const Vector3& start, Branch branch) {
  CuttingPlanes cuts;
  if (!CertifiedNewton::is_for(gap)) return climb_and_search(gap, settings, cuts, start, branch);
  CertifiedNewton newton(gap, cuts, settings, absolute_tolerance(gap, settings));
  const CertifiedNewton::End end = newton.run(start, branch);
  if (end == CertifiedNewton::End::Open) return climb_and_search(gap, settings, cuts, newton.best(), branch);
  const Status status = end == CertifiedNewton::End::Apart ? Status::Apart : Status::Converged;
  Proximity out = answer(gap, settings, newton.best(), std::numeric_limits<double>::infinity(), status);
  out.contact = contact_point(gap, newton.best());
  return out;
}

}  // namespace supernormal
