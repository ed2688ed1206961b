#include "proximity/search/contact_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "proximity/gap/limits.hpp"
#include "proximity/local/local_model.hpp"
#include "proximity/local/piecewise_model.hpp"
#include "proximity/local/regular_hessian.hpp"
#include "proximity/search/nearest_in_overlap.hpp"

namespace supernormal {
namespace {

// In units of the pair's length, or the tolerance if that is larger: points of tilted normals may be this far below the tangent
// plane.
constexpr double kDeepest = 1e-6;

// The tilt of a normal is kTilt times the possible error of the gap, over the distance that is left. A smaller tilt might not reach
// the far side of a face. If the tilt does not reach it, because the error is larger, the next tilt is larger by kGrowth.
constexpr double kTilt = 2;
constexpr double kGrowth = 10;

/// m; rounding error of the radii of curvature, in a basis that is aligned with the flatter body and not with the other.
double curvature_rounding(const Symmetric2& A1, const Symmetric2& A2) {
  return 4 * std::numeric_limits<double>::epsilon() * std::min(A1.xx + A1.yy, A2.xx + A2.yy);
}

/// Limits the distance of the contact from the middle of the witness points. For nearly parallel edges the computed meeting point
/// may be outside the bodies. Its distance from the witness points is at most their distance plus the length of the smaller body.
template <typename Vector>
Vector limited_shift(const GapFunction& gap, const Vector& shift, double half_distance) {
  const double length = shift.norm();
  if (length <= half_distance) return shift;
  const double radius = std::min(gap.shape1().half_extents().norm(), gap.shape2().half_extents().norm());
  const double limit = half_distance + 2 * radius;
  return length <= limit ? shift : Vector(shift * (limit / length));
}

/// The contact in a basis of the tangent plane that is aligned with the flattest face.
Vector3 contact_of_flat_bodies(const GapFunction& gap, const GapJet& jet, const Vector3& middle) {
  const LocalModel local = LocalModel::of(gap, jet);
  // If both radii of curvature are unknown, this gives both bodies half the weight.
  const double rounding = curvature_rounding(local.A1, local.A2);
  const Symmetric2 A1 = local.A1.plus_identity(rounding), A2 = local.A2.plus_identity(rounding);
  const Vector2 across = local.plane1.project(jet.d);
  // The tilt of the normal that would bring both points together, and the displacement of point 1 by this tilt.
  const Vector2 tilt = (A1 + A2).solve(across);
  // At two vertices no finite tilt does this, and the contact is the middle. The test comes before further arithmetic to avoid a
  // floating-point exception.
  if (!std::isfinite(tilt.x()) || !std::isfinite(tilt.y())) return middle;
  const Vector2 from_point1 = A1 * tilt;
  if (!std::isfinite(from_point1.x()) || !std::isfinite(from_point1.y())) return middle;
  const Vector2 from_middle = limited_shift(gap, Vector2(from_point1 - 0.5 * across), 0.5 * across.norm());
  return jet.jet1.r + local.plane1.lift(0.5 * across + from_middle) + 0.5 * jet.s * jet.n;
}

/// The contact of bodies in which balls of their smallest radii of curvature roll: a weighted mean of the witness points, where the
/// balls meet.
Vector3 contact_of_balls(const GapFunction& gap, const GapJet& jet) {
  const double radius1 = gap.shape1().min_curvature_radius_estimate(), radius2 = gap.shape2().min_curvature_radius_estimate();
  const double fraction = radius1 + radius2 > 0 ? radius1 / (radius1 + radius2) : 0.5;
  return jet.jet1.r + 0.5 * jet.s * jet.n + fraction * (jet.d - jet.s * jet.n);
}

/// Whether a point of the tangent plane is at most `near` (m) outside the body. `across` (m) is its distance from the body's
/// boundary point. Either `across` is small, or a ball that rolls inside the body is near the point.
bool is_near(const Shape& shape, double across, double near) {
  return across <= near || across * across <= 2 * near * shape.min_curvature_radius_estimate();
}

/// Whether the contact is within `near` (m) of both bodies.
bool is_near_both(const GapFunction& gap, const GapJet& jet, const Vector3& contact, double near) {
  const Vector3 from1 = contact - jet.jet1.r, from2 = from1 - jet.d;
  return is_near(gap.shape1(), (from1 - from1.dot(jet.n) * jet.n).norm(), near) &&
         is_near(gap.shape2(), (from2 - from2.dot(jet.n) * jet.n).norm(), near);
}

/// Witness pairs of normals near the contact's normal, projected onto its tangent plane.
class WitnessPairs {
 public:
  explicit WitnessPairs(const GapJet& jet) : plane_(TangentPlane::at(jet.n)) { add({jet.n, jet.jet1.r, jet.d}); }

  bool is_full() const { return count_ == kCapacity; }

  void add(const WitnessPair& pair) {
    pairs_[count_] = pair;
    pieces_[count_++] = {0, plane_.project(pair.d)};
  }

  /// The weighted mean of the pairs whose two points are nearest to each other. With this curvature, `u` is the displacement
  /// between them, m.
  PiecewiseModel::Peak nearest() const { return PiecewiseModel{{pieces_.data(), count_}, {1, 0, 1}}.maximize(); }

  Place middle(const GapFunction& gap, const PiecewiseModel::Peak& mean) const {
    const double radius1 = gap.shape1().rolling_radius(), radius2 = gap.shape2().rolling_radius();
    Place middle{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
    for (std::size_t k = 0; k < mean.count; ++k) {
      const auto& [n, point1, d] = pairs_[mean.active[k]];
      middle.point += mean.weight[k] * (point1 + 0.5 * d);
      middle.centre1 += mean.weight[k] * (point1 - radius1 * n);
      middle.centre2 += mean.weight[k] * (point1 + d + radius2 * n);
    }
    return middle;
  }

  const TangentPlane& plane() const { return plane_; }

 private:
  static constexpr std::size_t kCapacity = 16;

  TangentPlane plane_;
  std::array<WitnessPair, kCapacity> pairs_;
  std::array<Piece, kCapacity> pieces_;
  std::size_t count_ = 0;
};

/// A point that the two faces have in common, to within `near` (m). A face is the hull of the boundary points of nearby normals. A
/// normal tilted towards body 2's point has the farthest points of body 1 in this direction, and the farthest points of body 2 in
/// the opposite direction. So this is GJK in the tangent plane. The mean of points on both sides is below the tangent plane by at
/// most `below` (m), the tilt times the distance to the common point.
Place common_point(GapFunction& gap, const GapJet& jet, const StoppingRule& rule, double near,
                   std::span<const WitnessPair> beside) {
  WitnessPairs pairs(jet);
  for (const WitnessPair& pair : beside) pairs.add(pair);
  PiecewiseModel::Peak mean = pairs.nearest();
  const double deepest = std::max(kDeepest * gap.length_unit(), rule.tolerance());
  double below = kTilt * rule.tolerance();
  GapJet trial;
  while (!pairs.is_full() && rule.may_evaluate()) {
    const double apart = mean.u.norm();
    if (!(apart > near)) break;
    const Vector3 direction = pairs.plane().lift(mean.u / apart);
    gap.evaluate((jet.n + below / apart * direction).normalized(), Order::Point, trial);
    if (!trial.is_finite()) break;
    const double reached = trial.d.dot(direction);
    const bool is_progress = reached<apart - near, can_tilt_more = reached> near && below < deepest;
    if (!is_progress && !can_tilt_more) break;
    if (is_progress) {
      pairs.add({trial.n, trial.jet1.r, trial.d});
      mean = pairs.nearest();
    }
    // Faces that do not reach each other at this tilt may do so at a larger tilt.
    if (can_tilt_more) below = std::min(kGrowth * below, deepest);
  }
  return pairs.middle(gap, mean);
}

}  // namespace

Vector3 contact_between(const GapFunction& gap, const GapJet& jet) {
  if (!gap.has_hessian()) return contact_of_balls(gap, jet);
  const Vector3 middle = jet.jet1.r + 0.5 * jet.d;
  const Matrix3 H2 = gap.rotation() * jet.jet2.H * gap.rotation().transpose();
  const RegularHessian sum(jet.jet1.H + H2, 0, jet.n, gap.length_unit(), limits::kFlatContact);
  if (sum.is_regular()) {
    const Vector3 across = jet.d - jet.s * jet.n;
    // from_point1 is H1 times the tilt of the normal that would bring both points together: the displacement of point 1. At a sharp
    // edge this tilt is large, and its rounding also moves the point along the normal.
    const Vector3 from_point1 = jet.jet1.H * sum.solve(across);
    const Vector3 in_plane = from_point1 - from_point1.dot(jet.n) * jet.n;
    return middle + limited_shift(gap, Vector3(in_plane - 0.5 * across), 0.5 * across.norm());
  }
  return contact_of_flat_bodies(gap, jet, middle);
}

Vector3 contact_point(GapFunction& gap, const GapJet& jet, const StoppingRule& rule, std::span<const WitnessPair> beside) {
  const double near = std::max(limits::kNear * gap.length_unit(), rule.tolerance());
  Place place{contact_between(gap, jet), jet.jet1.r - gap.shape1().rolling_radius() * jet.n,
              jet.jet1.r + jet.d + gap.shape2().rolling_radius() * jet.n};
  // Where one body is round, the sharper body's own point is the best.
  if (!is_near_both(gap, jet, place.point, near)) place.point = contact_of_balls(gap, jet);
  if (!is_near_both(gap, jet, place.point, near)) place = common_point(gap, jet, rule, near, beside);
  // Move the point halfway between the tangent planes. Points of tilted normals, and vertices beside an edge, are below these.
  place.point += (jet.jet1.h + 0.5 * jet.s - jet.n.dot(place.point)) * jet.n;
  if (!(jet.s < 0) || is_in_overlap(gap, place, near) || move_into_ball(gap, place, near)) return place.point;
  return nearest_in_overlap(gap, jet, place.point, near, rule);
}

}  // namespace supernormal
