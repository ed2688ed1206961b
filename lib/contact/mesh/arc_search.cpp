#include "contact/mesh/arc_search.hpp"

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

/// Samples sorted by angle.
class Samples {
 public:
  Samples(const ArcSample& low, const ArcSample& high) : samples_{low, high} {}

  bool is_full() const { return count_ == samples_.size(); }
  std::size_t count() const { return count_; }
  const ArcSample& operator[](std::size_t i) const { return samples_[i]; }

  void insert(const ArcSample& sample) {
    std::size_t i = count_++;
    for (; samples_[i - 1].angle > sample.angle; --i) samples_[i] = samples_[i - 1];
    samples_[i] = sample;
  }

  std::size_t highest() const {
    const auto* const end = samples_.begin() + count_;
    const auto lower = [](const ArcSample& a, const ArcSample& b) { return a.gap < b.gap; };
    return static_cast<std::size_t>(std::max_element(samples_.begin(), end, lower) - samples_.begin());
  }

 private:
  std::array<ArcSample, kMostSamples> samples_;
  std::size_t count_ = 2;
};

}  // namespace

bool find_higher_maximum(SupportProbe& probe, const Arc& arc, ArcSample& low, ArcSample& high, double known, double tolerance) {
  Samples samples(low, high);
  const double to_beat = std::max({known, low.gap, high.gap}) + tolerance;
  while (true) {
    const std::size_t best = samples.highest();
    double angle = 0;
    double bound = std::max(to_beat, samples[best].gap + tolerance);
    bool is_complete = true;
    for (std::size_t i = 0; i + 1 < samples.count(); ++i) {
      const Interval interval(samples[i], samples[i + 1]);
      if (interval.bound <= bound) continue;
      bound = interval.bound;
      angle = interval.angle;
      is_complete = false;
    }
    if (is_complete || samples.is_full()) {
      if (samples[best].gap <= to_beat) return false;
      const std::size_t left = samples[best].slope >= 0 ? best : best - 1;
      low = samples[left];
      high = samples[left + 1];
      return true;
    }
    const ArcSample sample = arc.sample(angle, probe);
    if (sample.gap > 0) return false;  // the bodies are apart
    samples.insert(sample);
  }
}

}  // namespace supernormal
