#include "proximity/local/local_model.hpp"

namespace supernormal {
namespace {

/// The axis of the body's frame along which its boundary is flattest.
Vector3 flattest_axis(const Matrix3& H, double& radius) {
  int axis = 0;
  radius = H.diagonal().maxCoeff(&axis);
  return Vector3::Unit(axis);
}

/// A coordinate axis that is far from parallel to n.
Vector3 axis_across(const Vector3& n) {
  int axis = 0;
  n.cwiseAbs().minCoeff(&axis);
  return Vector3::Unit(axis);
}

QuadraticModel model_of(const TangentPlane& plane, const GapJet& jet, const Symmetric2& A) {
  return {plane.project(jet.d), A.plus_identity(jet.s)};
}

}  // namespace

LocalModel LocalModel::of(const GapFunction& gap, const GapJet& jet) {
  const Matrix3& R = gap.rotation();
  double radius1 = 0;
  double radius2 = 0;
  const Vector3 axis1 = flattest_axis(jet.jet1.H, radius1);
  const Vector3 axis2 = flattest_axis(jet.jet2.H, radius2);
  const bool first_is_flatter = radius1 >= radius2;
  // Two points have no curvature at all: any axis that is not the normal itself.
  const bool is_flat = radius1 > 0 || radius2 > 0;
  const TangentPlane plane =
      first_is_flatter ? TangentPlane(jet.n, is_flat ? axis1 : axis_across(jet.n)) : TangentPlane(-jet.m, axis2);
  const TangentPlane plane1 = first_is_flatter ? plane : plane.rotated(R);
  const TangentPlane plane2 = first_is_flatter ? plane.rotated(R.transpose()) : plane;
  const Symmetric2 A1 = Symmetric2::project(plane1, jet.jet1.H);
  const Symmetric2 A2 = Symmetric2::project(plane2, jet.jet2.H);
  return {plane1, plane2, A1, A2, model_of(plane1, jet, A1 + A2)};
}

LocalModel LocalModel::of(const GapFunction& gap, const GapJet& jet, const Matrix3& H) {
  const TangentPlane plane(jet.n, axis_across(jet.n));
  const Symmetric2 A = Symmetric2::project(plane, H);
  const Symmetric2 half{0.5 * A.xx, 0.5 * A.xy, 0.5 * A.yy};
  return {plane, plane.rotated(gap.rotation().transpose()), half, half, model_of(plane, jet, A)};
}

}  // namespace supernormal
