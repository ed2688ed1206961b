#include <algorithm>
#include <limits>

#include "proximity/answer.hpp"
#include "proximity/bounds/expanding_polytope.hpp"
#include "proximity/bounds/other_maxima.hpp"
#include "proximity/local/ascent.hpp"
#include "proximity/local/certified_newton.hpp"
#include "proximity/local/first_guess.hpp"
#include "proximity/local/meeting_point.hpp"
#include "proximity/local/vertex_cache.hpp"
#include "proximity/solvers.hpp"
#include "proximity/tuning.hpp"

namespace supernormal {

namespace {

// Normals m and n that are nearer than this have the same s to its rounding: |s(m) - s(n)| <= |m - n| L for bodies within L of one
// another, and GapFunction::rounding() is so many units of L.
constexpr double kSameNormal = 8 * std::numeric_limits<double>::epsilon();

/// How thoroughly other maxima are looked for; not at all where no evaluation is allowed.
ExpandingPolytope::Goal search_goal(const GapFunction& gap, const Settings& settings, Branch branch, double tolerance,
                                    double depth) {
  const int limit = settings.max_evaluations;
  if (settings.certify_depth) return {0, limit, 0.5 * tolerance, 0};
  const bool follows = branch == Branch::OfStart;
  if (follows && depth <= kTuning.followed_depth * gap.length_unit()) return {};
  // The estimate leaves out vertices where a radius of curvature vanishes at one normal alone. There a smooth partner has a radius
  // of its own, which a body with faces has not.
  const double min_radii = gap.shape1().min_curvature_radius_estimate() + gap.shape2().min_curvature_radius_estimate();
  if (!gap.shape2().has_kinks() && !may_have_other_maxima(min_radii, depth)) return {};
  const int most = std::min(limit, gap.evaluations() + kTuning.search_evaluations);
  if (follows) return {kTuning.branch_gain, most, std::max(kTuning.branch_gain * depth, tolerance), 0};
  return {kTuning.search_width, most, tolerance, kTuning.near_best * depth};
}

/// The answer after a search for higher maxima than `best`, in which that is put.
Proximity search(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const Settings& settings,
                 const ExpandingPolytope::Goal& goal, GapJet& best, Status status) {
  double error = ascent.error();
  ExpandingPolytope proof(gap, cuts, ascent, settings, absolute_tolerance(gap, settings));
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

/// Ends an ascent of two bodies with kinks: `best` is its last normal, `out` its answer. The witness points of `best` are then
/// those of the contact.
void meet(GapFunction& gap, const Settings& settings, GapJet& best, Proximity& out) {
  const double tolerance = absolute_tolerance(gap, settings);
  MeetingPoint meeting(gap);
  if (meeting.settle(tolerance, settings.max_evaluations, best)) {
    const double upper = out.gap + out.global_error;
    out = answer(gap, settings, best, std::max(out.error - gap.rounding(), 0.0), out.status);  // which adds the rounding
    out.global_error = std::min(out.global_error, upper - out.gap);
  }
  // The ascent has stalled where the cuts of body 1 coincide but for rounding. Its vertices do not. But they tell of what is near
  // the normal only: where the bounds decide, their error stands.
  if (out.status == Status::Stalled && !out.is_global) {
    const double estimate = kTuning.gain_safety * meeting.remaining_gain(best);
    if (estimate <= tolerance) {
      const Proximity ascended = out;
      out = answer(gap, settings, best, estimate, Status::Converged);
      out.global_error = std::min(out.global_error, ascended.global_error);
    }
  }
  out.point1 = best.jet1.r;
  out.point2 = best.jet1.r + best.d;
  meeting.move_witnesses(tolerance, best);
}

/// Climbs from the start, a normal or what was evaluated there; if the bodies overlap so deeply against their sharpest edges that
/// there may be other maxima, looks for a higher one, but leaves the branch of an earlier pose only when it has stopped being
/// nearly the best.
template <typename Start>
Proximity climb_and_search(GapFunction& gap, const Settings& settings, CuttingPlanes& cuts, const Start& start, Branch branch) {
  const double tolerance = absolute_tolerance(gap, settings);
  const bool follows = branch == Branch::OfStart && !settings.certify_depth;
  Ascent ascent(gap, cuts, settings, tolerance, follows ? kTuning.followed_depth * gap.length_unit() : 0);
  Status status = ascent.climb(start);
  GapJet best = ascent.best();
  Proximity out = answer(gap, settings, best, ascent.error(), status);
  if (!out.is_global && status != Status::InvalidInput) {
    const ExpandingPolytope::Goal goal = search_goal(gap, settings, branch, tolerance, -best.s);
    if (goal.max_evaluations > 0) out = search(gap, cuts, ascent, settings, goal, best, status);
  }
  if (gap.shape1().has_kinks() && gap.shape2().has_kinks() && status != Status::InvalidInput) {
    meet(gap, settings, best, out);
  }
  place_contact(gap, settings, best, out);
  if (gap.shape2().has_kinks() && status != Status::InvalidInput) {
    const Vector3 held = ascent.best().n == best.n ? ascent.held_normal() : VertexCache(gap).held_normal(best);
    if ((held - best.n).norm() <= kSameNormal) out.normal = held;
  }
  return out;
}

}  // namespace

Proximity solve_hybrid(GapFunction& gap, const Settings& settings, const Vector3& start, Branch branch) {
  CuttingPlanes cuts;
  // The first cut costs no evaluation: a centre of symmetry is at least as far from every tangent plane as the ball inside is
  // large.
  if (gap.shape1().is_symmetric() && gap.shape2().is_symmetric()) cuts.set_centre(gap.offset());
  if (!CertifiedNewton::is_for(gap)) return climb_and_search(gap, settings, cuts, start, branch);
  CertifiedNewton newton(gap, cuts, settings, absolute_tolerance(gap, settings));
  const CertifiedNewton::End end = newton.run(start, branch);
  if (end == CertifiedNewton::End::Open) return climb_and_search(gap, settings, cuts, newton.best(), branch);
  const Status status = end == CertifiedNewton::End::Apart ? Status::Apart : Status::Converged;
  Proximity out = answer(gap, settings, newton.best(), newton.error(), status);
  place_contact(gap, settings, newton.best(), out, newton.beside());
  return out;
}

}  // namespace supernormal
