// The hybrid solver, from top to bottom. Lemmas and parts in quotes are in lib/proximity/theory.md.
#include <algorithm>
#include <limits>
#include <optional>

#include "proximity/gap/tuning.hpp"
#include "proximity/local/meeting_point.hpp"
#include "proximity/local/vertex_cache.hpp"
#include "proximity/search/answer.hpp"
#include "proximity/search/ascent.hpp"
#include "proximity/search/certified_newton.hpp"
#include "proximity/search/expanding_polytope.hpp"
#include "proximity/search/solvers.hpp"

namespace supernormal {
namespace {

using SearchLimits = ExpandingPolytope::SearchLimits;

// |s(m) - s(n)| <= |m - n| L for bodies within L of each other, and GapFunction::rounding() is this many units of L. So normals
// nearer to each other than this have the same s, to rounding.
constexpr double kSameNormal = 8 * std::numeric_limits<double>::epsilon();

/// One query.
class Hybrid {
 public:
  Hybrid(GapFunction& gap, const Settings& settings, WantedMaximum wanted)
      : gap_(gap), settings_(settings), wanted_(wanted), rule_(gap, settings) {}

  Proximity solve(const Vector3& start);

  /// Goes on where the lanes ended (lanes/certified_newton_lanes.hpp).
  Proximity resume(const GapJet& best, std::span<const Vector3> cuts);

 private:
  void add_centre();
  bool is_tracked() const { return wanted_ == WantedMaximum::Tracked; }
  Proximity climb(const auto& start);
  std::optional<SearchLimits> search_limits() const;
  Proximity search(Ascent& ascent, const SearchLimits& limits);
  void meet(Proximity& out);

  GapFunction& gap_;
  const Settings& settings_;
  const WantedMaximum wanted_;
  const StoppingRule rule_;
  CuttingPlanes cuts_;
  GapJet best_;  // the highest evaluation
  Status status_ = Status::Converged;
};

// Lemma 1: the cut of the centre costs no evaluation.
void Hybrid::add_centre() {
  if (gap_.traits1().is_symmetric && gap_.traits2().is_symmetric) cuts_.set_centre(gap_.offset());
}

Proximity Hybrid::resume(const GapJet& best, std::span<const Vector3> cuts) {
  add_centre();
  for (const Vector3& cut : cuts) cuts_.add(cut);
  cuts_.add(best.d + gap_.rolling_radius() * best.n);
  return climb(best);
}

Proximity Hybrid::solve(const Vector3& start) {
  add_centre();

  // Lemma 2 with Newton's steps answers nearly every query of a simulation ("Fast path").
  if (!CertifiedNewton::is_for(gap_)) return climb(start);
  CertifiedNewton newton(gap_, cuts_, rule_);
  const CertifiedNewton::End end = newton.run(start, wanted_);
  if (end == CertifiedNewton::End::Open) return climb(newton.best());
  const Status status = end == CertifiedNewton::End::Apart ? Status::Apart : Status::Converged;
  Proximity out = answer(gap_, rule_, newton.best(), newton.error(), status);
  place_contact(gap_, rule_, newton.best(), out, newton.beside());
  return out;
}

/// Climbs from `start`, a normal or its evaluation.
Proximity Hybrid::climb(const auto& start) {
  // One local maximum ("Ascent"). Where lemma 3 does not hold, the ascent asks for a proof of the overlap first.
  const bool stays_with_maximum = is_tracked() && !settings_.certify_depth;
  Ascent ascent(gap_, cuts_, rule_, stays_with_maximum ? kTuning.unsearched_depth * gap_.length_unit() : 0);
  status_ = ascent.climb(start);
  best_ = ascent.best();
  Proximity out = answer(gap_, rule_, best_, ascent.error(), status_);

  // Lemma 3 says whether it is the only one. Otherwise a depth may be less elsewhere ("Other maxima").
  if (!out.is_global && status_ != Status::InvalidInput) {
    if (const std::optional<SearchLimits> limits = search_limits()) out = search(ascent, *limits);
  }

  // The ascent knows the vertices of body 2 alone ("Colliders with faces and edges").
  const bool has_vertices = gap_.traits2().has_nonsmooth_points && status_ != Status::InvalidInput;
  if (has_vertices && gap_.traits1().has_nonsmooth_points) meet(out);

  // "Where a contact acts"
  place_contact(gap_, rule_, best_, out);
  if (has_vertices) {
    const Vector3 exact = ascent.best().n == best_.n ? ascent.exact_normal() : VertexCache(gap_).exact_normal(best_);
    if ((exact - best_.n).norm() <= kSameNormal) out.normal = exact;
  }
  return out;
}

/// The limits of the search for other maxima, or none where no search is needed.
std::optional<SearchLimits> Hybrid::search_limits() const {
  const double depth = -best_.s, tolerance = rule_.tolerance();
  if (settings_.certify_depth) return SearchLimits{0, settings_.max_evaluations, 0.5 * tolerance, 0};
  if (is_tracked() && depth <= kTuning.unsearched_depth * gap_.length_unit()) return std::nullopt;
  // If a ball with the radius `depth` rolls inside the Minkowski difference, the maximum is the only one (Blaschke's theorem). The
  // smallest radii of curvature add. The estimates of the radii ignore vertices where the radius vanishes at a single normal. There
  // a smooth partner adds a radius of its own, but a body with faces does not.
  const double min_radii = gap_.shape1().min_curvature_radius_estimate() + gap_.shape2().min_curvature_radius_estimate();
  const bool is_smooth = !gap_.traits2().has_nonsmooth_points;
  if (is_smooth && !(depth > kTuning.depth_per_radius * min_radii)) return std::nullopt;
  const int most = gap_.evaluations() + kTuning.search_evaluations;
  // "Tracking": a tracked maximum is only left when it is clearly not the highest any more.
  if (is_tracked()) return SearchLimits{kTuning.leaving_gain, most, std::max(kTuning.leaving_gain * depth, tolerance), 0};
  return SearchLimits{kTuning.search_width, most, tolerance, kTuning.near_best * depth};
}

/// The answer after a search for higher maxima than the best.
Proximity Hybrid::search(Ascent& ascent, const SearchLimits& limits) {
  double error = ascent.error();
  ExpandingPolytope proof(gap_, cuts_, ascent, rule_);
  const bool is_reached = proof.run(limits, best_, error, status_);
  if (!is_reached && !rule_.may_evaluate()) status_ = Status::EvaluationLimit;
  const bool is_proved = is_reached && settings_.certify_depth;
  if (is_proved) {
    error = proof.excess();
    status_ = Status::Converged;
  }
  Proximity out = answer(gap_, rule_, best_, error, status_);
  // Lemma 4
  out.global_error = std::min(out.global_error, proof.excess() + gap_.rounding());
  out.is_global = out.is_global || is_proved;
  return out;
}

/// Ends an ascent of two bodies with nonsmooth points. The witness points of the best become the contact's.
void Hybrid::meet(Proximity& out) {
  MeetingPoint meeting(gap_);
  if (meeting.settle(rule_, best_)) {
    const double upper = out.gap + out.global_error;
    // answer() adds the rounding again.
    out = answer(gap_, rule_, best_, std::max(out.error - gap_.rounding(), 0.0), out.status);
    out.global_error = std::min(out.global_error, upper - out.gap);
  }
  // The ascent has stalled because the cuts of body 1 coincide to rounding. Its vertices do not. But they only describe the
  // neighbourhood of the normal. So the error stands where bounds have decided.
  if (out.status == Status::Stalled && !out.is_global) {
    const double estimate = kTuning.gain_safety * meeting.remaining_gain(best_);
    if (rule_.allows(estimate)) {
      const Proximity ascended = out;
      out = answer(gap_, rule_, best_, estimate, Status::Converged);
      out.global_error = std::min(out.global_error, ascended.global_error);
    }
  }
  out.point1 = best_.jet1.r;
  out.point2 = best_.jet1.r + best_.d;
  meeting.move_witnesses(rule_.tolerance(), best_);
}

}  // namespace

Proximity solve_hybrid(GapFunction& gap, const Settings& settings, const Vector3& start, WantedMaximum wanted) {
  return Hybrid(gap, settings, wanted).solve(start);
}

Proximity resume_hybrid(GapFunction& gap, const Settings& settings, const GapJet& best, std::span<const Vector3> cuts,
                        WantedMaximum wanted) {
  return Hybrid(gap, settings, wanted).resume(best, cuts);
}

}  // namespace supernormal
