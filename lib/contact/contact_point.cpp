#include "contact/contact_point.hpp"

#include "solvers/local_model.hpp"

namespace supernormal {

Vector3 contact_point(const GapFunction& gap, const GapJet& jet) {
  const Vector3 middle = jet.jet1.r + 0.5 * jet.d;
  if (!gap.has_curvature()) return middle;
  const LocalModel local = LocalModel::of(gap, jet);
  // From point 1 towards point 2, in the plane, by body 1's share of the flatness.
  const Vector2 apart = local.plane1.project(jet.d);
  const Vector2 from_point1 = (local.A1 + local.A2).solve(local.A1 * apart);
  if (!from_point1.allFinite()) return middle;
  return jet.jet1.r + local.plane1.lift(from_point1) + 0.5 * jet.s * jet.n;
}

}  // namespace supernormal
