#include "contact/mesh/arc.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal {
namespace {

/// Bisects until the gap increases into the interval from both ends. If it increases from one end only, this end is the higher one.
/// The maximum then lies before the first sample that is not higher. Returns false if the bodies are apart.
bool bracket(SupportProbe& probe, const Arc& arc, ArcSample& low, ArcSample& high, int last_evaluation) {
  bool rises_from_low = low.slope >= 0;
  bool rises_from_high = high.slope <= 0;
  while (!(rises_from_low && rises_from_high) && probe.evaluations() < last_evaluation) {
    const ArcSample middle = arc.sample(0.5 * (low.angle + high.angle), probe);
    if (middle.gap > 0) return false;
    if (rises_from_low) {
      rises_from_high = middle.slope <= 0;
      (rises_from_high || middle.gap <= low.gap ? high : low) = middle;
    } else {
      rises_from_low = middle.slope >= 0;
      (rises_from_low || middle.gap <= high.gap ? low : high) = middle;
    }
  }
  return true;
}

/// Keeps the side of `middle` into which the gap increases. But if `middle` is lower than the higher end by more than `tolerance`
/// (m), the side of that end contains a maximum at least as high as the end, so it is kept. The gap may then increase into the
/// interval from that end only.
void narrow(const ArcSample& middle, ArcSample& low, ArcSample& high, double tolerance) {
  const bool is_beyond_maximum = low.gap >= high.gap && middle.gap < low.gap - tolerance;
  const bool is_before_maximum = low.gap < high.gap && middle.gap < high.gap - tolerance;
  (is_before_maximum || (middle.slope > 0 && !is_beyond_maximum) ? low : high) = middle;
}

bool is_bracket(const ArcSample& low, const ArcSample& high) { return low.slope >= 0 && high.slope <= 0; }

/// Chooses the next angle by the ITP method (Oliveira, Takahashi: An enhancement of the bisection method average performance
/// preserving minmax optimality, ACM TOMS 47, 2020). It needs at most one step more than bisection, and converges superlinearly on
/// a smooth slope.
class Interpolation {
 public:
  explicit Interpolation(double width) : first_width_(width), reach_(width) {}

  double next(const ArcSample& low, const ArcSample& high) {
    const double width = high.angle - low.angle;
    const double middle = low.angle + 0.5 * width;
    const double secant = low.angle + width * (low.slope / (low.slope - high.slope));
    const double towards_middle = std::copysign(1.0, middle - secant);
    const double truncation = std::min(0.2 * width * width / first_width_, std::abs(middle - secant));
    const double truncated = secant + towards_middle * truncation;
    const double allowed = std::max(reach_ - 0.5 * width, 0.0);
    reach_ *= 0.5;
    return std::abs(truncated - middle) <= allowed ? truncated : middle - towards_middle * allowed;
  }

 private:
  double first_width_;
  double reach_;  // half of bisection's width one step later
};

/// Bounds the maximum above the samples: where s is concave, it lies below its tangents at both ends.
double bound_above(const ArcSample& low, const ArcSample& high) {
  const double descent = low.slope - high.slope;
  return descent > 0 ? low.slope * -high.slope / descent * (high.angle - low.angle) : 0;
}

/// The angle at which both points are equally deep. It is the maximum if the body has no point beyond their chord. On a nearly flat
/// side of the body the slope jumps there.
double equal_depth_angle(const Arc& arc, const ArcSample& low, const ArcSample& high) {
  const Vector3 chord = low.point - high.point;
  const double sine = arc.from.dot(chord);
  const double cosine = -arc.towards.dot(chord);
  return sine < 0 ? std::atan2(-sine, -cosine) : std::atan2(sine, cosine);
}

}  // namespace

Vector3 Arc::normal(double angle) const { return (std::cos(angle) * from + std::sin(angle) * towards).normalized(); }

ArcSample Arc::sample(double angle, const Vector3& point) const {
  const Vector3 reach = point - edge_point;
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const double out_of_face = from.dot(reach);
  const double beyond_edge = towards.dot(reach);
  return {angle, cosine * beyond_edge - sine * out_of_face, cosine * out_of_face + sine * beyond_edge, point};
}

ArcSample Arc::sample(double angle, SupportProbe& probe) const { return sample(angle, probe.deepest(normal(angle)).point); }

bool have_maximum_between(const ArcSample& low, const ArcSample& high, double level) {
  const bool rises_from_low = low.slope > level;
  const bool rises_from_high = high.slope < -level;
  return (rises_from_low && (rises_from_high || high.gap <= low.gap)) || (rises_from_high && low.gap <= high.gap);
}

ArcMaximum maximize_between(SupportProbe& probe, const Arc& arc, ArcSample low, ArcSample high, double tolerance,
                            int max_evaluations) {
  const int last_evaluation = probe.evaluations() + max_evaluations;
  ArcMaximum best;
  if (!bracket(probe, arc, low, high, last_evaluation)) return best;
  Interpolation interpolation(high.angle - low.angle);
  const auto is_inside = [&](double angle) { return low.angle < angle && angle < high.angle; };
  const auto is_settled = [&] { return !is_bracket(low, high) || bound_above(low, high) <= tolerance; };
  for (int step = 0; !is_settled() && probe.evaluations() < last_evaluation; ++step) {
    double angle = step % 2 == 0 ? equal_depth_angle(arc, low, high) : interpolation.next(low, high);
    if (!is_inside(angle)) angle = interpolation.next(low, high);
    if (!is_inside(angle)) break;  // `low` and `high` are adjacent numbers
    const ArcSample middle = arc.sample(angle, probe);
    if (middle.gap > 0) return best;
    narrow(middle, low, high, tolerance);
    if (is_bracket(low, high)) continue;
    if (!bracket(probe, arc, low, high, last_evaluation)) return best;
    interpolation = Interpolation(high.angle - low.angle);
  }
  const bool is_bracketed = is_bracket(low, high);
  best.error =
      is_bracketed ? bound_above(low, high) : std::max(std::abs(low.slope), std::abs(high.slope)) * (high.angle - low.angle);
  // Interpolate the point even if the two are far apart. Then a flat side of the body lies across the edge, and all its points have
  // the same support normal.
  const double descent = low.slope - high.slope;
  const double share = is_bracketed && descent > 0 ? low.slope / descent : 0.5;
  best.normal = arc.normal(low.angle + share * (high.angle - low.angle));
  best.point = low.point + share * (high.point - low.point);
  best.is_apart = false;
  best.gap = best.normal.dot(best.point - arc.edge_point);
  best.converged = best.error <= tolerance;
  return best;
}

}  // namespace supernormal
