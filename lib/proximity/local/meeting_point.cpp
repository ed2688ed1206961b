#include "proximity/local/meeting_point.hpp"

#include <algorithm>
#include <array>

#include "base/finite.hpp"
#include "proximity/local/piecewise_model.hpp"

namespace supernormal {
namespace {

// In units of the bodies' sizes: the curvature of pairs of vertices that overlap, because a maximum needs some. At the maximum
// itself the weights do not depend on it.
constexpr double kLeastCurvature = 1e-3;

// In units of the rounding error of s: heights that differ by less are equal.
constexpr double kSameHeight = 4;

/// The active vertices of a body, or its boundary point if it has none.
ActiveVertices vertices_of(const Shape& shape, const Vector3& n, const Jet& jet, const Vector3& toward) {
  ActiveVertices vertices;
  shape.add_active_vertices(n, toward, vertices);
  if (vertices.size() == 0) vertices.add(jet.r);
  return vertices;
}

/// m; the distance of the two witness points in the plane across the normal.
double distance_across(const GapJet& jet) { return (jet.d - jet.s * jet.n).norm(); }

}  // namespace

/// The maximum of the pieces near a normal.
struct MeetingPoint::Maximum {
  double gain;                                                 ///< m; of s
  Vector3 n;                                                   ///< unit; the normal of the maximum
  Vector3 point1 = Vector3::Zero(), point2 = Vector3::Zero();  ///< m; witness points, each in its body's frame
  double separation = 0;  ///< m; how far they are below the tangent planes of the normal that the pieces are for
};

MeetingPoint::Maximum MeetingPoint::maximum_near(const GapJet& jet) const {
  const Matrix3& rotation = gap_.rotation();
  const ActiveVertices one = vertices_of(gap_.shape1(), jet.n, jet.jet1, jet.jet1.r + jet.d);
  const ActiveVertices two = vertices_of(gap_.shape2(), jet.m, jet.jet2, rotation.transpose() * (jet.jet1.r - gap_.offset()));
  const TangentPlane plane = TangentPlane::at(jet.n);
  std::array<Piece, ActiveVertices::kCapacity * ActiveVertices::kCapacity> pieces;
  std::size_t count = 0;
  for (int i = 0; i < one.size(); ++i) {
    const double separation1 = std::max(jet.jet1.h - jet.n.dot(one[i]), 0.0);
    for (int j = 0; j < two.size(); ++j) {
      const double separation2 = std::max(jet.jet2.h - jet.m.dot(two[j]), 0.0);
      const Vector3 difference = rotation * two[j] + (gap_.offset() - one[i]);
      pieces[count++] = {separation1 + separation2, plane.project(difference)};
    }
  }
  Symmetric2 curvature;
  if (gap_.has_hessian()) curvature = Symmetric2::project(plane, gap_.curvature(jet));
  const double size = gap_.shape1().half_extents().norm() + gap_.shape2().half_extents().norm();
  // Over the sphere of normals, n.d has the curvature -n.d. So a pair of vertices that are apart decreases like s.
  const Symmetric2 A = curvature.plus_identity(std::max(jet.s, 0.0) + kLeastCurvature * size);
  const PiecewiseModel::Peak peak = PiecewiseModel{{pieces.data(), count}, A}.maximize();

  Maximum maximum{peak.gain, (jet.n + plane.lift(peak.u)).normalized()};
  for (std::size_t k = 0; k < peak.count; ++k) {
    const auto pair = static_cast<int>(peak.active[k]);
    maximum.separation += peak.weight[k] * pieces[peak.active[k]].value;
    maximum.point1 += peak.weight[k] * one[pair / two.size()];
    maximum.point2 += peak.weight[k] * two[pair % two.size()];
  }
  return maximum;
}

/// Moves `jet` to the maximum if that is higher.
bool MeetingPoint::climb(GapJet& jet) {
  const Maximum maximum = maximum_near(jet);
  if (!(maximum.gain > kSameHeight * gap_.rounding()) || !all_finite(maximum.n)) return false;
  GapJet trial;
  gap_.evaluate(maximum.n, gap_.has_hessian() ? Order::Hessian : Order::Point, trial);
  if (!(trial.s > jet.s)) return false;
  jet = trial;
  return true;
}

// A climb that gains less than the tolerance is for the witness points only. It is discarded if it does not bring them together,
// because near the normal of a curved face the vertices are only some of its points.
bool MeetingPoint::settle(const StoppingRule& rule, GapJet& jet) {
  const double rounding = kSameHeight * gap_.rounding();
  move_witnesses(rounding, jet);
  GapJet higher = jet;
  while (rule.forbids(distance_across(higher)) && rule.may_evaluate() && climb(higher)) {
    move_witnesses(rounding, higher);
  }
  if (rule.allows(higher.s - jet.s) && distance_across(higher) >= distance_across(jet)) return false;
  jet = higher;
  return true;
}

double MeetingPoint::remaining_gain(const GapJet& jet) const { return std::max(maximum_near(jet).gain, 0.0); }

void MeetingPoint::move_witnesses(double largest_separation, GapJet& jet) const {
  if (distance_across(jet) <= gap_.rounding()) return;
  const Maximum maximum = maximum_near(jet);
  if (!(maximum.separation <= largest_separation)) return;
  GapJet moved = jet;
  moved.jet1.r = maximum.point1;
  moved.jet2.r = maximum.point2;
  moved.d = gap_.rotation() * moved.jet2.r + (gap_.offset() - moved.jet1.r);
  if (distance_across(moved) < distance_across(jet)) jet = moved;
}

}  // namespace supernormal
