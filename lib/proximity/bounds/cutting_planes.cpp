#include "proximity/bounds/cutting_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace supernormal {
namespace {

// Slopes are compared relative to the steepest cut: a ridge whose slope is below this share of it is level.
constexpr double kLevelSlope = 1e-14;

// Cuts whose values differ by less than this share of the largest value or slope meet at a point.
constexpr double kTie = 1e-13;

// As the square of a length over another.
constexpr double kShort = 0.01;

constexpr double kFullTurn = 2 * std::numbers::pi;

// Ways that are walked whatever the cuts.
constexpr int kWays = 8;

// Between ways this near each other (radians) none is looked for: it may be open by rounding only.
constexpr double kNarrow = 1e-3;

/// One cut over the tangent plane: value + slope.u
struct Cut {
  double value;
  Vector2 slope;

  double at(const Vector2& u) const { return value + slope.dot(u); }
};

/// The point of the segment a b nearest to the origin. Between the ends it is exactly across the segment, however short: the slopes
/// of two flat faces may be a thousand times steeper than the ridge where they meet. Of a segment that is short itself, as between
/// two neighbours on a rim, the product would cancel.
Vector2 nearest_on_segment(const Vector2& a, const Vector2& b) {
  const Vector2 edge = b - a;
  // Asked of each end by itself: their difference drowns in the rounding of a long segment.
  if (!(a.dot(edge) < 0)) return a;
  if (!(b.dot(edge) > 0)) return b;
  const double squared = edge.squaredNorm();
  if (squared < kShort * a.squaredNorm()) return a - a.dot(edge) / squared * edge;
  return (a.x() * b.y() - a.y() * b.x()) / squared * Vector2(edge.y(), -edge.x());
}

using Cuts = std::array<Cut, CuttingPlanes::kCapacity>;

/// Steepest ascent of the least of some cuts that are equal here: the element of least norm in the convex hull of their slopes,
/// zero where their minimum has its maximum. It lies on a vertex or an edge of the hull, in front of which no slope lies, or the
/// hull holds the origin. Slopes of very different length meet on flat faces: rounding is that of the steepest.
Vector2 steepest_ascent(const Cuts& cuts, std::size_t count) {
  double steepest = 0;
  for (std::size_t i = 0; i < count; ++i) steepest = std::max(steepest, cuts[i].slope.norm());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i; j < count; ++j) {
      const Vector2 nearest = nearest_on_segment(cuts[i].slope, cuts[j].slope);
      const double least = nearest.squaredNorm() - kLevelSlope * steepest * nearest.norm();
      const auto is_behind = [&](const Cut& cut) { return cut.slope.dot(nearest) >= least; };
      if (std::all_of(cuts.begin(), cuts.begin() + count, is_behind)) return nearest;
    }
  }
  return Vector2::Zero();
}

/// The distance to walk from u along the unit vector p until |u| = radius.
double distance_to_circle(const Vector2& u, const Vector2& p, double radius) {
  const double along = u.dot(p);
  const double rest = std::max(0.0, radius * radius - u.squaredNorm());
  return -along + std::sqrt(along * along + rest);
}

/// The distance from u = 0 along `way` (unit) to where a cut, value + slope.u, is below level u^2/2 next; not to where it is for
/// less than `least`.
double distance_to_discs(std::span<const Cut> cuts, const Vector2& way, double level, double least) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Cut& cut : cuts) {
    const double slope = cut.slope.dot(way);
    const double discriminant = slope * slope + 2 * level * cut.value;
    if (!(slope < 0 && discriminant > 0)) continue;
    // Between the roots; the larger is sum / -level.
    const double sum = std::sqrt(discriminant) - slope;
    if (sum > -level * least) nearest = std::min(nearest, 2 * cut.value / sum);
  }
  return nearest;
}

/// Ways around u = 0, radians.
class Angles {
 public:
  void add(double angle) { angles_[count_++] = angle; }

  /// Those between which the cut is below level u^2/2 somewhere beyond `least`: they touch that disc, or meet its rim at `least`.
  void add_tangents(const Cut& cut, double level, double least) {
    const double touching = std::sqrt(-2 * level * cut.value), beyond = -level * least;
    const double least_slope = touching < beyond ? 0.5 * (beyond + touching * (touching / beyond)) : touching;
    const double steepest = cut.slope.norm();
    if (!(least_slope < steepest)) return;
    const double middle = std::atan2(-cut.slope.y(), -cut.slope.x());
    const double half = std::acos(least_slope / steepest);
    for (const double angle : {middle - half, middle + half}) add(std::remainder(angle, kFullTurn));
  }

  /// Halfway between neighbours that are not too near each other.
  template <typename Function>
  void for_each_middle(const Function& function) {
    const std::span<double> sorted(angles_.data(), count_);
    std::ranges::sort(sorted);
    for (std::size_t k = 0; k < count_; ++k) {
      const double next = k + 1 < count_ ? sorted[k + 1] : sorted[0] + kFullTurn;
      if (next - sorted[k] > kNarrow) function(0.5 * (sorted[k] + next));
    }
  }

 private:
  std::array<double, kWays + 2 * CuttingPlanes::kCapacity> angles_;
  std::size_t count_ = 0;
};

}  // namespace

double CuttingPlanes::upper_bound(const Vector3& m) const {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < size(); ++k) least = std::min(least, m.dot(d_[static_cast<std::size_t>(k)]));
  return least;
}

CuttingPlanes::Maximum CuttingPlanes::maximize(const TangentPlane& plane, double radius) const {
  Cuts cuts, met;
  const auto count = static_cast<std::size_t>(size());
  double steepest = 0;
  double scale = 0;
  Maximum best{Vector2::Zero(), std::numeric_limits<double>::infinity(), 0, false};
  for (std::size_t k = 0; k < count; ++k) {
    cuts[k] = {plane.n.dot(d_[k]), plane.project(d_[k])};
    best.value = std::min(best.value, cuts[k].value);
    steepest = std::max(steepest, cuts[k].slope.norm());
    scale = std::max(scale, std::abs(cuts[k].value));
  }
  scale = std::max(scale, steepest);
  for (std::size_t step = 0; step < 2 * count; ++step) {
    std::size_t met_count = 0;
    double highest_met = best.value;
    for (std::size_t k = 0; k < count; ++k) {
      const double value = cuts[k].at(best.u);
      if (value > best.value + kTie * scale) continue;
      met[met_count++] = cuts[k];
      highest_met = std::max(highest_met, value);
    }
    const Vector2 ascent = steepest_ascent(met, met_count);
    const double slope = ascent.norm();
    if (slope <= kLevelSlope * steepest) {
      best.is_interior = true;
      best.uncertainty = highest_met - best.value;  // a mean of these cuts is level, and lies above their least everywhere
      break;
    }
    // Walk up until another cut becomes the lowest, or to the rim.
    const Vector2 p = ascent / slope;
    double distance = distance_to_circle(best.u, p, radius);
    bool reaches_rim = true;
    for (std::size_t k = 0; k < count; ++k) {
      const double value = cuts[k].at(best.u);
      const double closing = slope - cuts[k].slope.dot(p);
      if (value <= best.value + kTie * scale || closing <= 0) continue;
      const double reach = (value - best.value) / closing;
      if (reach < distance) {
        distance = reach;
        reaches_rim = false;
      }
    }
    best.u += distance * p;
    best.value += distance * slope;
    if (reaches_rim) break;
  }
  return best;
}

// At u the unit normal is shorter than n + u, and so is its s: s > level there is a cut above level sqrt(1 + u^2), which is at
// least level (1 + u^2/2). So each cut closes a disc, and what is open between discs is open between two neighbours of their
// tangents; but what a disc closes nearer than `least` does not count.
CuttingPlanes::Reach CuttingPlanes::reach(const TangentPlane& plane, const Vector2& u, double level, double least) const {
  Cuts around;
  Angles angles;
  for (int way = 0; way < kWays; ++way) angles.add(std::remainder(kFullTurn * way / kWays, kFullTurn));
  const std::span<const Cut> cuts(around.data(), static_cast<std::size_t>(size()));
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const double height = plane.n.dot(d_[k]) + plane.project(d_[k]).dot(u) - level * (1 + 0.5 * u.squaredNorm());
    around[k] = {std::max(height, 0.0), plane.project(d_[k]) - level * u};
    angles.add_tangents(around[k], level, least);
  }
  Reach farthest;
  const auto walk = [&](double angle) {
    const Vector2 way(std::cos(angle), std::sin(angle));
    const double distance = distance_to_discs(cuts, way, level, least);
    if (distance > farthest.distance) farthest = {way, distance};
  };
  for (int way = 0; way < kWays; ++way) walk(kFullTurn * way / kWays);
  angles.for_each_middle(walk);
  return farthest;
}

}  // namespace supernormal
