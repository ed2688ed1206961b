#include "proximity/answer.hpp"

#include <algorithm>
#include <limits>

namespace supernormal {
namespace {

// A bound is the length of a vector less s, and each of its three components has the rounding error of s. So the bound cannot fall
// below about three rounding errors.
constexpr double kFloor = 4;

}  // namespace

double absolute_tolerance(const GapFunction& gap, const Settings& settings) {
  return std::max(settings.tolerance * gap.length_unit() - gap.rounding(), kFloor * gap.rounding());
}

double optimality_gap_bound(const GapJet& jet, double rolling_radius) {
  // Rounding of d may make this negative, because a large body's boundary point is rotated.
  return std::max((jet.d + rolling_radius * jet.n).norm() - (jet.s + rolling_radius), 0.0);
}

Proximity answer(const GapFunction& gap, const Settings& settings, const GapJet& jet, double model_error, Status status) {
  Proximity out;
  out.gap = jet.s;
  out.normal = jet.n;
  out.point1 = jet.jet1.r;
  out.point2 = jet.jet1.r + jet.d;
  out.contact = 0.5 * (out.point1 + out.point2);
  out.evaluations = gap.evaluations();
  out.status = status;
  if (status == Status::Apart || status == Status::Diverged) model_error = std::numeric_limits<double>::infinity();
  const double tolerance = absolute_tolerance(gap, settings);
  // s + rho is the gap function of the bodies without the balls that roll inside them. If it is positive, those bodies are apart,
  // and it is concave on the cone of the separating normals. If touching bodies have a stationary point with s = -x, the largest
  // gap is at most x, because s extended to all vectors is concave.
  const bool is_concave = jet.s + gap.rolling_radius() > 0;
  const bool is_touching = 2 * jet.s >= -tolerance;
  out.is_global = jet.s > 0 || (status != Status::Diverged && (is_concave || is_touching));
  // Where s need not be concave, the model proves nothing, however small its error. So the answer claims no more than the
  // tolerance.
  if (!is_concave) model_error = std::max(model_error, tolerance);
  const double excess = optimality_gap_bound(jet, gap.rolling_radius());
  out.error = std::min(model_error, excess) + gap.rounding();
  out.global_error = out.is_global ? std::max(out.error, tolerance + gap.rounding()) : excess + gap.rounding();
  return out;
}

void place_contact(GapFunction& gap, const Settings& settings, const GapJet& jet, Proximity& out,
                   std::span<const WitnessPair> beside) {
  if (out.status == Status::InvalidInput) return;
  const bool is_guess = out.status == Status::Apart || out.status == Status::Diverged;
  const int max_evaluations = is_guess ? 0 : settings.max_evaluations;
  out.contact = contact_point(gap, jet, absolute_tolerance(gap, settings), max_evaluations, beside);
  out.evaluations = gap.evaluations();
}

}  // namespace supernormal
