#include "proximity/local/remaining_gain_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supernormal {
namespace {

// The slowest contraction that is believed, and the one assumed before two steps have shown it; and the sum of its series, which no
// change of the curvature exceeds.
constexpr double kSlowestContraction = 0.95;
constexpr double kMost = 1 / (1 - kSlowestContraction);

// Towards the normals of a sharp tip, where the curvature has changed by more than kMost, and where steps hardly shrink, s may rise
// this much farther: unless the contraction is fast, and the curvature does not fade with the steps.
constexpr double kTipSafety = 10;

// A curvature that falls to less than this share of itself in one step fades: the next step may find as little left of it.
constexpr double kFading = 0.5;

// Steps that shrink by less than this may cross a shelf, beyond which s rises as before.
constexpr double kSlowSteps = 0.6;

// Where the slope falls like the square of the distance to a shelf, so that the curvature falls like the distance, a step of
// Newton's goes half of the way. The curvature may end within so many of them.
constexpr double kShelfSteps = 4;

// Steps that each promise more than this share of the last may zigzag, when there are so many in a row.
constexpr double kSlowShare = 0.3;
constexpr int kManySlowSteps = 4;

// Steps longer than this (radians) reach to where the curvature may be another (two vertices of exponent 1.02 change theirs within
// 1/50): the contraction is not believed.
constexpr double kAsymptoticStep = 1e-3;

// A step that came this far (radians) to the normals of a sharp tip says nothing of the contraction there.
constexpr double kFarStep = 0.03;

// A step of this share of the trust radius is held back by it: the model beyond has just been found wrong.
constexpr double kAtRim = 0.98;

// Of the larger curvature: a smaller one is rounding.
constexpr double kFlat = 4 * std::numeric_limits<double>::epsilon();

// A step below the spacing of double-precision directions, about: what has changed with it is rounding.
constexpr double kSpacing = 1e-14;

/// At most the slowest that is believed; asked before dividing, which might overflow.
double contraction_of(double before, double now) { return now < kSlowestContraction * before ? now / before : kSlowestContraction; }

/// The factor by which a size has changed, at most kMost; asked before dividing, which might overflow.
double change_of(double before, double now) {
  const auto [low, high] = std::minmax(before, now);
  return high < kMost * low ? high / low : kMost;
}

/// The factor by which the curvature has changed, the way that it has changed most.
double change_of(const Eigen2& before, const Eigen2& now) {
  const auto low = [](const Eigen2& e) { return std::max(std::abs(e.low), kFlat * e.high); };
  return std::max(change_of(low(before), low(now)), change_of(before.high, now.high));
}

/// Whether it has become small, any way.
bool fades(const Eigen2& before, const Eigen2& now) { return now.low < kFading * before.low || now.high < kFading * before.high; }

/// Whether the curvature that has fallen so much with the last step would end within a few of the next.
bool ends_soon(double before, double now, double last_step, double step) {
  return kShelfSteps * step * (before - now) > now * last_step;
}

/// Whether a body has a sharp tip, where the radii of curvature are 0: other than corners, which an ascent knows.
bool has_tips(const GapFunction& gap) {
  return gap.shape1().min_curvature_radius_estimate() == 0 ||
         (!gap.shape2().has_kinks() && gap.shape2().min_curvature_radius_estimate() == 0);
}

}  // namespace

void RemainingGainEstimate::restart() {
  last_.gain = 0;
  slow_steps_ = 0;
  steps_grow_ = false;
  near_degenerate_stationary_point_ = false;
}

double RemainingGainEstimate::learn(const Promise& now, double radius) {
  const bool is_rounding = now.gain <= gap_.rounding();
  const bool is_slow = last_.gain > 0 && now.gain > kSlowShare * last_.gain && !is_rounding;
  slow_steps_ = is_slow ? slow_steps_ + 1 : 0;
  if (last_.gain > 0 || is_rounding) steps_grow_ = now.step >= last_.step && !is_rounding;

  const bool is_held_back = now.step >= kAtRim * radius;
  double gains = kMost;
  bool is_unknown = false;
  bool is_fading = false;
  if (last_.gain > 0) {
    const Eigen2 before(last_.curvature);
    const Eigen2 curvature(now.curvature);
    // The step's way need not be that of the least curvature, which may have been another's.
    const Vector2 way = now.way.normalized();
    const Vector2 way_before = last_.plane.project(now.plane.lift(way));
    const double along_before = way_before.dot(last_.curvature * way_before);
    const double along = way.dot(now.curvature * way);
    is_fading = fades(before, curvature) || along < kFading * along_before;
    near_degenerate_stationary_point_ = ends_soon(before.low, curvature.low, last_.step, now.step);
    const bool is_far = is_held_back || now.step >= kAsymptoticStep || (last_.step > kFarStep && has_tips(gap_));
    if (!is_far) {
      // Where one direction converges fast, the gain hides that another is slow; the step tells it.
      const double of_steps = is_rounding ? 0 : contraction_of(last_.step, now.step);
      const double contraction = std::max(contraction_of(last_.gain, now.gain), of_steps);
      const double change = change_of(before, curvature);
      is_unknown = (change == kMost && now.step > kSpacing) || of_steps > kSlowSteps ||
                   (!is_rounding && ends_soon(along_before, along, last_.step, now.step));
      gains = is_unknown ? kMost : std::min((is_rounding ? 1 : change) / (1 - contraction), kMost);
    }
  } else if (is_rounding) {
    near_degenerate_stationary_point_ = false;
  }
  last_ = now;
  if (!std::isfinite(now.gain)) last_.gain = 0;

  const double error = kSafety * gains * now.gain;
  // What is below rounding is believed to be the last, but not where the model has just been found wrong, nor far away.
  const bool is_last = is_rounding && now.step < kAsymptoticStep && !is_held_back;
  const bool is_at_tip = (is_slow || is_fading || gains == kMost) && !is_last && has_tips(gap_);
  return (is_at_tip || is_unknown) && error <= tolerance_ ? kTipSafety * error : error;
}

bool RemainingGainEstimate::may_zigzag() {
  if (slow_steps_ < kManySlowSteps) return false;
  slow_steps_ = 0;
  return true;
}

}  // namespace supernormal
