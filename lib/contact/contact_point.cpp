#include "contact/contact_point.hpp"

#include "solvers/local_model.hpp"

namespace supernormal {

Vector3 contact_point(const GapFunction& gap, const GapJet& jet) {
  const Vector3 middle = jet.jet1.r + 0.5 * jet.d;
  if (!gap.has_curvature()) return middle;
  const LocalModel local = LocalModel::of(gap, jet);
  // The turn of the normal that would bring both points together, and how far it moves point 1.
  const Vector2 turn = (local.A1 + local.A2).solve(local.plane1.project(jet.d));
  const Vector2 from_point1 = local.A1 * turn;
  if (!from_point1.allFinite()) return middle;
  return jet.jet1.r + local.plane1.lift(from_point1) + 0.5 * jet.s * jet.n;
}

}  // namespace supernormal
