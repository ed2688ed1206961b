#include "proximity/contact_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "proximity/local/local_model.hpp"
#include "proximity/local/regular_hessian.hpp"

namespace supernormal {
namespace {

// A radius of curvature beyond this, in units of the pair's length, drowns those across it unless the basis is aligned with it.
constexpr double kFlat = 1e4;

/// Rounding error of the radii of curvature, m, in a basis that is aligned with the flatter body and not with the other.
double curvature_rounding(const Symmetric2& A1, const Symmetric2& A2) {
  return 4 * std::numeric_limits<double>::epsilon() * std::min(A1.xx + A1.yy, A2.xx + A2.yy);
}

/// Limits the distance of the contact from the middle of the witness points. If edges are nearly parallel, the place where they
/// would meet may be outside the bodies; it cannot be farther from the witness points than these are apart and the smaller body
/// is long.
template <typename Vector>
Vector within_reach(const GapFunction& gap, const Vector& shift, double half_distance) {
  const double length = shift.norm();
  if (length <= half_distance) return shift;
  const double radius = std::min(gap.shape1().half_extents().norm(), gap.shape2().half_extents().norm());
  const double reach = half_distance + 2 * radius;
  return length <= reach ? shift : Vector(shift * (reach / length));
}

/// The contact in a basis of the tangent plane that is aligned with the flattest face.
Vector3 contact_of_flat_bodies(const GapFunction& gap, const GapJet& jet, const Vector3& middle) {
  const LocalModel local = LocalModel::of(gap, jet);
  // The same number added to both gives half the weight to each if neither radius of curvature is known.
  const double rounding = curvature_rounding(local.A1, local.A2);
  const Symmetric2 A1 = local.A1.plus_identity(rounding), A2 = local.A2.plus_identity(rounding);
  const Vector2 across = local.plane1.project(jet.d);
  // The turn of the normal that would bring both points together, and how far it moves point 1.
  const Vector2 turn = (A1 + A2).solve(across);
  // If no finite turn does, at two vertices, the middle is taken; testing it before computing with it avoids a floating-point
  // exception.
  if (!std::isfinite(turn.x()) || !std::isfinite(turn.y())) return middle;
  const Vector2 from_point1 = A1 * turn;
  if (!std::isfinite(from_point1.x()) || !std::isfinite(from_point1.y())) return middle;
  const Vector2 from_middle = within_reach(gap, Vector2(from_point1 - 0.5 * across), 0.5 * across.norm());
  return jet.jet1.r + local.plane1.lift(0.5 * across + from_middle) + 0.5 * jet.s * jet.n;
}

}  // namespace

Vector3 contact_point(const GapFunction& gap, const GapJet& jet) {
  const Vector3 middle = jet.jet1.r + 0.5 * jet.d;
  if (!gap.has_hessian()) return middle;
  const Matrix3 H2 = gap.rotation() * jet.jet2.H * gap.rotation().transpose();
  const RegularHessian sum(jet.jet1.H + H2, 0, jet.n, gap.length_unit(), kFlat);
  if (sum.is_regular()) {
    const Vector3 across = jet.d - jet.s * jet.n;
    // H1 times the turn of the normal that would bring both points together: how far it moves point 1. Where that turn is large,
    // at a sharp edge, its rounding moves the point along the normal, too.
    const Vector3 from_point1 = jet.jet1.H * sum.solve(across);
    const Vector3 in_plane = from_point1 - from_point1.dot(jet.n) * jet.n;
    return middle + within_reach(gap, Vector3(in_plane - 0.5 * across), 0.5 * across.norm());
  }
  return contact_of_flat_bodies(gap, jet, middle);
}

}  // namespace supernormal
