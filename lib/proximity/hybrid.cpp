#include <algorithm>
#include <limits>
#include <optional>

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

// |s(m) - s(n)| <= |m - n| L for bodies within L of each other, and GapFunction::rounding() is this many units of L. So normals
// nearer to each other than this have the same s, to rounding.
constexpr double kSameNormal = 8 * std::numeric_limits<double>::epsilon();

/// The limits of the search for other maxima, or none where no search is needed.
std::optional<ExpandingPolytope::SearchLimits> search_limits(const GapFunction& gap, const Settings& settings, WantedMaximum wanted,
                                                             double tolerance, double depth) {
  using Limits = ExpandingPolytope::SearchLimits;
  if (settings.certify_depth) return Limits{0, settings.max_evaluations, 0.5 * tolerance, 0};
  const bool follows = wanted == WantedMaximum::Tracked;
  if (follows && depth <= kTuning.followed_depth * gap.length_unit()) return std::nullopt;
  // The estimate ignores vertices where the radius of curvature vanishes at a single normal. There a smooth partner adds a radius
  // of its own, but a body with faces does not.
  const double min_radii = gap.shape1().min_curvature_radius_estimate() + gap.shape2().min_curvature_radius_estimate();
  if (!gap.shape2().has_kinks() && !may_have_other_maxima(min_radii, depth)) return std::nullopt;
  const int most = gap.evaluations() + kTuning.search_evaluations;
  if (follows) return Limits{kTuning.branch_gain, most, std::max(kTuning.branch_gain * depth, tolerance), 0};
  return Limits{kTuning.search_width, most, tolerance, kTuning.near_best * depth};
}

/// The answer after a search for higher maxima than `best`, which it updates.
Proximity search(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const StoppingRule& rule,
                 const ExpandingPolytope::SearchLimits& limits, bool certifies, GapJet& best, Status status) {
  double error = ascent.error();
  ExpandingPolytope proof(gap, cuts, ascent, rule);
  const bool is_reached = proof.run(limits, best, error, status);
  if (!is_reached && !rule.may_evaluate()) status = Status::EvaluationLimit;
  const bool is_proved = is_reached && certifies;
  if (is_proved) {
    error = proof.excess();
    status = Status::Converged;
  }
  Proximity out = answer(gap, rule, best, error, status);
  out.global_error = std::min(out.global_error, proof.excess() + gap.rounding());
  out.is_global = out.is_global || is_proved;
  return out;
}

/// Ends an ascent of two bodies with nonsmooth points. `best` is its last evaluation, `out` its answer. The witness points of
/// `best` become the contact's.
void meet(GapFunction& gap, const StoppingRule& rule, GapJet& best, Proximity& out) {
  MeetingPoint meeting(gap);
  if (meeting.settle(rule, best)) {
    const double upper = out.gap + out.global_error;
    // answer() adds the rounding again.
    out = answer(gap, rule, best, std::max(out.error - gap.rounding(), 0.0), out.status);
    out.global_error = std::min(out.global_error, upper - out.gap);
  }
  // The ascent has stalled because the cuts of body 1 coincide to rounding. Its vertices do not. But they only describe the
  // neighbourhood of the normal. So the error stands where bounds have decided.
  if (out.status == Status::Stalled && !out.is_global) {
    const double estimate = kTuning.gain_safety * meeting.remaining_gain(best);
    if (rule.allows(estimate)) {
      const Proximity ascended = out;
      out = answer(gap, rule, best, estimate, Status::Converged);
      out.global_error = std::min(out.global_error, ascended.global_error);
    }
  }
  out.point1 = best.jet1.r;
  out.point2 = best.jet1.r + best.d;
  meeting.move_witnesses(rule.tolerance(), best);
}

/// Climbs from `start`, a normal or its evaluation. Looks for a higher maximum if the overlap is so deep, relative to the sharpest
/// edges, that there may be others. A tracked maximum is only left when it is clearly not the highest any more.
template <typename Start>
Proximity climb_and_search(GapFunction& gap, const Settings& settings, const StoppingRule& rule, CuttingPlanes& cuts,
                           const Start& start, WantedMaximum wanted) {
  const bool follows = wanted == WantedMaximum::Tracked && !settings.certify_depth;
  Ascent ascent(gap, cuts, rule, follows ? kTuning.followed_depth * gap.length_unit() : 0);
  Status status = ascent.climb(start);
  GapJet best = ascent.best();
  Proximity out = answer(gap, rule, best, ascent.error(), status);
  if (!out.is_global && status != Status::InvalidInput) {
    const auto limits = search_limits(gap, settings, wanted, rule.tolerance(), -best.s);
    if (limits) out = search(gap, cuts, ascent, rule, *limits, settings.certify_depth, best, status);
  }
  if (gap.shape1().has_kinks() && gap.shape2().has_kinks() && status != Status::InvalidInput) {
    meet(gap, rule, best, out);
  }
  place_contact(gap, rule, best, out);
  if (gap.shape2().has_kinks() && status != Status::InvalidInput) {
    const Vector3 exact = ascent.best().n == best.n ? ascent.exact_normal() : VertexCache(gap).exact_normal(best);
    if ((exact - best.n).norm() <= kSameNormal) out.normal = exact;
  }
  return out;
}

/// The first cut costs no evaluation: the distance from a centre of symmetry to every tangent plane is at least the radius of the
/// rolling ball.
CuttingPlanes first_cuts(const GapFunction& gap) {
  CuttingPlanes cuts;
  if (gap.shape1().is_symmetric() && gap.shape2().is_symmetric()) cuts.set_centre(gap.offset());
  return cuts;
}

/// The answer of Newton's method, or of the search that goes on where it ended.
Proximity after_newton(GapFunction& gap, const Settings& settings, const StoppingRule& rule, CuttingPlanes& cuts,
                       const CertifiedNewton& newton, CertifiedNewton::End end, WantedMaximum wanted) {
  if (end == CertifiedNewton::End::Open) return climb_and_search(gap, settings, rule, cuts, newton.best(), wanted);
  const Status status = end == CertifiedNewton::End::Apart ? Status::Apart : Status::Converged;
  Proximity out = answer(gap, rule, newton.best(), newton.error(), status);
  place_contact(gap, rule, newton.best(), out, newton.beside());
  return out;
}

}  // namespace

Proximity solve_hybrid(GapFunction& gap, const Settings& settings, const Vector3& start, WantedMaximum wanted) {
  const StoppingRule rule(gap, settings);
  CuttingPlanes cuts = first_cuts(gap);
  if (!CertifiedNewton::is_for(gap)) return climb_and_search(gap, settings, rule, cuts, start, wanted);
  CertifiedNewton newton(gap, cuts, rule);
  return after_newton(gap, settings, rule, cuts, newton, newton.run(start, wanted), wanted);
}

Proximity resume_hybrid(GapFunction& gap, const Settings& settings, const GapJet& best, std::span<const Vector3> known_cuts,
                        WantedMaximum wanted) {
  const StoppingRule rule(gap, settings);
  CuttingPlanes cuts = first_cuts(gap);
  for (const Vector3& cut : known_cuts) cuts.add(cut);
  CertifiedNewton newton(gap, cuts, rule);
  return after_newton(gap, settings, rule, cuts, newton, newton.resume(best), wanted);
}

}  // namespace supernormal
