#include "proximity/local/local_model.hpp"

namespace supernormal {
namespace {

/// The axis of the body's frame along which its boundary is flattest.
Vector3 flattest_axis(const Matrix3& H, double& radius) {
  int axis = 0;
  radius = H.diagonal().maxCoeff(&axis);
  return Vector3::Unit(axis);
}

/// The plane across the normal, with its basis along the flattest axis. A point has no curvature and no such axis.
TangentPlane plane_along(const Vector3& axis, double radius, const Vector3& normal) {
  return radius > 0 ? TangentPlane(normal, axis) : TangentPlane::at(normal);
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
  const TangentPlane plane = first_is_flatter ? plane_along(axis1, radius1, jet.n) : plane_along(axis2, radius2, -jet.m);
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
