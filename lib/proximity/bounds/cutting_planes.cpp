#include "proximity/bounds/cutting_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supernormal {
namespace {

// Relative to the steepest half-space's slope: a ridge with a smaller slope counts as level.
constexpr double kLevelSlope = 1e-14;

// Relative to the largest value or slope: half-spaces whose values differ by less meet at a point.
constexpr double kTie = 1e-13;

// The square of a ratio of lengths.
constexpr double kShort = 0.01;

/// A supporting half-space over the tangent plane: value + slope.u.
struct Cut {
  double value;
  Vector2 slope;

  double at(const Vector2& u) const { return value + slope.dot(u); }
};

/// The point of the segment a b nearest to the origin. Between the ends it is exactly perpendicular to the segment, however short
/// it is: the slopes of two flat faces may be a thousand times steeper than the ridge where they meet. For a short segment, as
/// between two neighbours on a curved edge, the product would cancel.
Vector2 nearest_on_segment(const Vector2& a, const Vector2& b) {
  const Vector2 edge = b - a;
  // Each end has its own test, because their difference would drown in the rounding of a long segment.
  if (!(a.dot(edge) < 0)) return a;
  if (!(b.dot(edge) > 0)) return b;
  const double squared = edge.squaredNorm();
  if (squared < kShort * a.squaredNorm()) return a - a.dot(edge) / squared * edge;
  return cross(a, b) / squared * Vector2(edge.y(), -edge.x());
}

using Cuts = std::array<Cut, 1 + CuttingPlanes::kCapacity>;

/// Steepest ascent of the minimum of half-spaces that are equal here: the element of least norm in the convex hull of their slopes.
/// It is zero where the minimum of the half-spaces has its maximum. It lies on a vertex or an edge of the hull with no slope in
/// front of it; otherwise the hull contains the origin. Slopes of very different lengths meet on flat faces, so the steepest sets
/// the rounding error.
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

/// The distance from u along the unit vector p to the circle |u| = radius.
double distance_to_circle(const Vector2& u, const Vector2& p, double radius) {
  const double along = u.dot(p);
  const double rest = std::max(0.0, radius * radius - u.squaredNorm());
  return -along + std::sqrt(along * along + rest);
}

}  // namespace

void CuttingPlanes::add(const Vector3& d) {
  std::size_t place = 1;
  if (count_ < kCapacity) {
    place += static_cast<std::size_t>(count_++);
  } else if (kept_at_.isZero(0)) {
    place += static_cast<std::size_t>(oldest_++ % kCapacity);
  } else {
    for (std::size_t k = 2; k <= kCapacity; ++k) {
      if (kept_at_.dot(d_[k]) > kept_at_.dot(d_[place])) place = k;
    }
  }
  d_[place] = d;
}

double CuttingPlanes::upper_bound(const Vector3& m) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3& d : points()) least = std::min(least, m.dot(d));
  return least;
}

CuttingPlanes::Maximum CuttingPlanes::maximize(const TangentPlane& plane, double radius) const {
  Cuts cuts, met;
  const std::span<const Vector3> d = points();
  const std::size_t count = d.size();
  double steepest = 0;
  double scale = 0;
  Maximum best{Vector2::Zero(), std::numeric_limits<double>::infinity(), 0, false};
  for (std::size_t k = 0; k < count; ++k) {
    cuts[k] = {plane.n.dot(d[k]), plane.project(d[k])};
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
      // A mean of these half-spaces is level, and it is nowhere below their minimum.
      best.uncertainty = highest_met - best.value;
      break;
    }
    // Walk up until another half-space becomes the lowest, or to the circle.
    const Vector2 p = ascent / slope;
    double distance = distance_to_circle(best.u, p, radius);
    bool reaches_circle = true;
    for (std::size_t k = 0; k < count; ++k) {
      const double value = cuts[k].at(best.u);
      const double closing = slope - cuts[k].slope.dot(p);
      if (value <= best.value + kTie * scale || closing <= 0) continue;
      const double distance_to_cut = (value - best.value) / closing;
      if (distance_to_cut < distance) {
        distance = distance_to_cut;
        reaches_circle = false;
      }
    }
    best.u += distance * p;
    best.value += distance * slope;
    if (reaches_circle) break;
  }
  return best;
}

}  // namespace supernormal
