#include "contact/mesh/arc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace supernormal {
namespace {

// Enough for the usual tolerance, at two samples per digit, and for several maxima.
constexpr std::size_t kMostSamples = 64;

// Smallest distance of a new sample from the ends of its interval, relative to the interval.
constexpr double kFromEnds = 1e-3;

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

/// Where the slope would be 0 if it were linear. It converges superlinearly on a smooth slope.
double secant_angle(const ArcSample& low, const ArcSample& high) {
  return low.angle + (high.angle - low.angle) * (low.slope / (low.slope - high.slope));
}

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

/// The upper bound of the gap at another angle, from the body's point in `sample`.
double bound_at(const ArcSample& sample, double angle) {
  return sample.gap * std::cos(angle - sample.angle) + sample.slope * std::sin(angle - sample.angle);
}

/// The angle between two adjacent samples at which their bounds allow the largest gap.
struct Interval {
  double angle = 0;
  double bound;  // m

  Interval(const ArcSample& low, const ArcSample& high) : bound(std::max(low.gap, high.gap)) {
    // Both bounds are sinusoids. The lower of the two peaks at the top of one sinusoid or where they intersect.
    const double width = high.angle - low.angle;
    const double meet = std::atan2(low.gap - bound_at(high, low.angle), bound_at(high, low.angle + 0.5 * std::numbers::pi) -
                                                                            bound_at(low, low.angle + 0.5 * std::numbers::pi));
    for (const double candidate : {low.angle + (meet < 0 ? meet + std::numbers::pi : meet),
                                   low.angle + std::atan2(low.slope, low.gap), high.angle + std::atan2(high.slope, high.gap)}) {
      if (!(low.angle < candidate && candidate < high.angle)) continue;
      const double value = std::min(bound_at(low, candidate), bound_at(high, candidate));
      if (value <= bound) continue;
      bound = value;
      angle = std::clamp(candidate, low.angle + kFromEnds * width, high.angle - kFromEnds * width);
    }
  }
};

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
  const auto is_inside = [&](double angle) { return low.angle < angle && angle < high.angle; };
  const auto is_settled = [&] { return !is_bracket(low, high) || bound_above(low, high) <= tolerance; };
  for (int step = 0; !is_settled() && probe.evaluations() < last_evaluation; ++step) {
    // In turn, since each alone may stay at one end.
    double angle = step % 2 == 0 ? equal_depth_angle(arc, low, high) : secant_angle(low, high);
    if (!is_inside(angle)) angle = 0.5 * (low.angle + high.angle);
    if (!is_inside(angle)) break;  // `low` and `high` are adjacent numbers
    const ArcSample middle = arc.sample(angle, probe);
    if (middle.gap > 0) return best;
    narrow(middle, low, high, tolerance);
    if (!is_bracket(low, high) && !bracket(probe, arc, low, high, last_evaluation)) return best;
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

bool find_higher_maximum(SupportProbe& probe, const Arc& arc, ArcSample& low, ArcSample& high, double known, double tolerance) {
  std::array<ArcSample, kMostSamples> samples{low, high};  // sorted by angle
  std::size_t count = 2;
  const double to_beat = std::max({known, low.gap, high.gap}) + tolerance;
  while (true) {
    const auto lower = [](const ArcSample& a, const ArcSample& b) { return a.gap < b.gap; };
    const auto best = static_cast<std::size_t>(std::max_element(samples.begin(), samples.begin() + count, lower) - samples.begin());
    double angle = 0;
    double bound = std::max(to_beat, samples[best].gap + tolerance);
    bool is_complete = true;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const Interval interval(samples[i], samples[i + 1]);
      if (interval.bound <= bound) continue;
      bound = interval.bound;
      angle = interval.angle;
      is_complete = false;
    }
    if (is_complete || count == samples.size()) {
      if (samples[best].gap <= to_beat) return false;
      const std::size_t left = samples[best].slope >= 0 ? best : best - 1;
      low = samples[left];
      high = samples[left + 1];
      return true;
    }
    const ArcSample sample = arc.sample(angle, probe);
    if (sample.gap > 0) return false;  // the bodies are apart
    std::size_t i = count++;
    for (; samples[i - 1].angle > sample.angle; --i) samples[i] = samples[i - 1];
    samples[i] = sample;
  }
}

}  // namespace supernormal
