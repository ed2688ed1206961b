#include "proximity/local/local_model.hpp"

namespace supernormal {
namespace {

QuadraticModel model_of(const TangentPlane& plane, const GapJet& jet, const Symmetric2& A) {
  return {plane.project(jet.d), A.plus_identity(jet.s)};
}

}  // namespace

LocalModel LocalModel::of(const GapFunction& gap, const GapJet& jet) {
  const Matrix3& R = gap.rotation();
  const bool first_is_flatter = jet.jet1.H.diagonal().maxCoeff() >= jet.jet2.H.diagonal().maxCoeff();
  const TangentPlane plane =
      first_is_flatter ? TangentPlane::along_flattest(jet.n, jet.jet1.H) : TangentPlane::along_flattest(-jet.m, jet.jet2.H);
  const TangentPlane plane1 = first_is_flatter ? plane : plane.rotated(R);
  const TangentPlane plane2 = first_is_flatter ? plane.rotated(R.transpose()) : plane;
  const Symmetric2 A1 = Symmetric2::project(plane1, jet.jet1.H);
  const Symmetric2 A2 = Symmetric2::project(plane2, jet.jet2.H);
  return {plane1, plane2, A1, A2, model_of(plane1, jet, A1 + A2)};
}

LocalModel LocalModel::of(const GapFunction& gap, const GapJet& jet, const Matrix3& H) {
  const TangentPlane plane = TangentPlane::at(jet.n);
  const Symmetric2 A = Symmetric2::project(plane, H);
  const Symmetric2 half{0.5 * A.xx, 0.5 * A.xy, 0.5 * A.yy};
  return {plane, plane.rotated(gap.rotation().transpose()), half, half, model_of(plane, jet, A)};
}

}  // namespace supernormal
