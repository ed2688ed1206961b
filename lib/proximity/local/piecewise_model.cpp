#include "proximity/local/piecewise_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/finite.hpp"

namespace supernormal {
namespace {

using Peak = PiecewiseModel::Peak;
using Indices = std::array<std::size_t, 4>;

// Relative to the radius: a step may be this long, because it is only a trial.
constexpr double kOvershoot = 1.1;
constexpr int kMaxShifts = 24;  // the secant method takes two to four

// Relative to its interval: the shift is not searched nearer to the ends.
constexpr double kLeastFraction = 1e-2;

// Relative to the values: a piece that is lower than the maximum by less is not lower.
constexpr double kValueRounding = 1e-15;

// Gnomonic: if pieces meet farther away than about this, they are parallel to rounding.
constexpr double kFarthestMeeting = 1e100;

bool is_moderate(double numerator, double denominator) { return is_quotient_within(numerator, denominator, kFarthestMeeting); }

double inverse(double length) { return length > 0 ? 1 / length : std::numeric_limits<double>::infinity(); }

/// The maxima of one, two or three pieces alone, on the set where they are equal.
class Candidates {
 public:
  Candidates(const PiecewiseModel& model, const Indices& subset, std::size_t count)
      : model_(model), subset_(subset), count_(count) {
    best_.gain = -std::numeric_limits<double>::infinity();
  }

  /// The best maximum over all sets of at most three pieces of the subset that contain its last piece.
  Peak best() {
    const std::size_t last = subset_[count_ - 1];
    try_one(last);
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      try_two(subset_[i], last);
      for (std::size_t j = i + 1; j + 1 < count_; ++j) try_three(subset_[i], subset_[j], last);
    }
    return best_;
  }

 private:
  const Piece& piece(std::size_t k) const { return model_.pieces[k]; }

  void offer(const Peak& peak) {
    // Tested first, because an infinite u would raise floating-point exceptions below.
    if (!all_finite(peak.u)) return;
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count_; ++k) {
      lowest = std::min(lowest, piece(subset_[k]).at(peak.u));
    }
    const double gain = lowest - 0.5 * peak.u.dot(model_.A * peak.u);
    if (!(gain > best_.gain)) return;
    best_ = peak;
    best_.gain = gain;
  }

  void try_one(std::size_t i) { offer({model_.A.solve(piece(i).slope), 0, {i, 0, 0}, {1, 0, 0}, 1}); }

  // Solves on the line where the two are equal, and not as a sum of their own maxima, which are far away if A is nearly singular.
  void try_two(std::size_t i, std::size_t j) {
    const Vector2 difference = piece(j).slope - piece(i).slope;
    const double squared = difference.squaredNorm();
    const Vector2 line(-difference.y(), difference.x());
    const double curvature = line.dot(model_.A * line);
    const double height = piece(i).value - piece(j).value;
    if (!is_moderate(height, squared)) return;
    const Vector2 foot = height / squared * difference;
    const double slope = line.dot(piece(i).slope - model_.A * foot);
    if (!is_moderate(slope, curvature)) return;
    const Vector2 u = foot + slope / curvature * line;
    const double fraction = difference.dot(model_.A * u - piece(i).slope) / squared;
    if (!(fraction >= 0 && fraction <= 1)) return;
    offer({u, 0, {i, j, 0}, {1 - fraction, fraction, 0}, 2});
  }

  void try_three(std::size_t i, std::size_t j, std::size_t k) {
    const Vector2 a = piece(j).slope - piece(i).slope;
    const Vector2 b = piece(k).slope - piece(i).slope;
    const double determinant = cross(a, b);
    const double ra = piece(i).value - piece(j).value;
    const double rb = piece(i).value - piece(k).value;
    const Vector2 meeting(ra * b.y() - rb * a.y(), a.x() * rb - b.x() * ra);
    if (!is_moderate(meeting.x(), determinant) || !is_moderate(meeting.y(), determinant)) return;
    const Vector2 u = meeting / determinant;
    const Vector2 rest = model_.A * u - piece(i).slope;
    const double wj = cross(rest, b) / determinant;
    const double wk = cross(a, rest) / determinant;
    if (!(wj >= 0 && wk >= 0 && wj + wk <= 1)) return;
    offer({u, 0, {i, j, k}, {1 - wj - wk, wj, wk}, 3});
  }

  const PiecewiseModel& model_;
  const Indices& subset_;
  const std::size_t count_;
  Peak best_;
};

}  // namespace

double lowest_value(std::span<const Piece> pieces) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces) lowest = std::min(lowest, piece.value);
  return lowest;
}

PiecewiseModel::Peak PiecewiseModel::maximize() const {
  if (pieces.empty()) return {Vector2::Zero(), std::numeric_limits<double>::infinity(), {}, {}, 0};
  Indices subset{};
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    if (pieces[k].value < pieces[subset[0]].value) subset[0] = k;
  }
  Peak peak = Candidates(*this, subset, 1).best();
  for (std::size_t step = 0; step < 4 * pieces.size(); ++step) {
    const double curvature = 0.5 * peak.u.dot(A * peak.u);
    const double height = peak.gain + curvature;
    std::size_t lowest = peak.active[0];
    double lowest_value = height - kValueRounding * (std::abs(height) + curvature);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const double value = pieces[k].at(peak.u);
      if (!(value < lowest_value)) continue;
      lowest = k;
      lowest_value = value;
    }
    const auto end = peak.active.begin() + peak.count;
    if (std::find(peak.active.begin(), end, lowest) != end) return peak;
    std::copy(peak.active.begin(), end, subset.begin());
    subset[peak.count] = lowest;
    const Peak lower = Candidates(*this, subset, peak.count + 1).best();
    if (!(lower.gain < peak.gain)) return peak;
    peak = lower;
  }
  return peak;
}

PiecewiseModel::Peak PiecewiseModel::maximize(double radius) const {
  const double low = Eigen2(A).low;
  const auto shifted = [&](double shift) {
    Peak peak = PiecewiseModel{pieces, A.plus_identity(shift)}.maximize();
    peak.gain += 0.5 * shift * peak.u.squaredNorm();
    return peak;
  };
  double steepest = 0;
  for (const Piece& piece : pieces) steepest = std::max(steepest, piece.slope.norm());
  // |u| decreases with the shift, and |u| <= steepest / (low + shift).
  double below = low > 0 ? 0 : -low;
  double above = std::max(steepest / radius - low, below + kLeastFraction * std::abs(low));
  if (low > 0) {
    const Peak peak = shifted(0);
    if (peak.u.norm() <= kOvershoot * radius) return peak;
  }
  Peak best = shifted(above);
  double inverse_below = 0;
  double inverse_above = inverse(best.u.norm());
  for (int step = 0; step < kMaxShifts && best.u.norm() * kOvershoot < radius; ++step) {
    if (!(above - below > kLeastFraction * above)) break;  // nonsmooth points keep u inside the radius
    // 1/|u| is a nearly linear function of the shift.
    const double fraction = std::isfinite(inverse_above) && inverse_above > inverse_below
                                ? (1 / radius - inverse_below) / (inverse_above - inverse_below)
                                : 0.5;
    const double shift = below + std::clamp(fraction, kLeastFraction, 1 - kLeastFraction) * (above - below);
    const Peak peak = shifted(shift);
    const double length = peak.u.norm();
    if (length <= kOvershoot * radius) {
      best = peak;
      above = shift;
      inverse_above = inverse(length);
    } else {
      below = shift;
      inverse_below = inverse(length);
    }
  }
  return best;
}

}  // namespace supernormal
