// The notation is in lib/proximity/theory.md, "Derivatives".
#include "supernormal/proximity/derivatives.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/usable_pose.hpp"
#include "proximity/derivatives/common_normal.hpp"
#include "proximity/derivatives/gradient_of_answer.hpp"
#include "proximity/gap/limits.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal {
namespace {

// The columns of the twists.
constexpr int kV1 = 0, kW1 = 3, kV2 = 6, kW2 = 9;

// How far a witness point may move, beyond what its derivative says, as a body rotates by kNearby: this part of what it says, or so
// many sizes of the smaller body. Of 12 000 flat pairs (`pairs flat_derivatives 6000 5`, and 6) 3 gradients are wrong, as with
// 0.01. With 1, 438 are wrong.
constexpr double kBend = 0.1;
constexpr double kLeastBend = 1e-5;  // with 1e-6, 3 % fewer of these pairs have Jacobians; with 1e-4, 1 % more

// In sizes of the smaller body: a point that so moves by more jumps. By as much the gradient may be off. With 1e-2, 3 % more of
// these pairs have one.
constexpr double kJump = 1e-3;

// Of the smallest half-extent: the tolerance of a gap whose change over kNearby tells a slope to kLeastBend. With 1e-14, some
// queries of sharp bodies end without an answer, and one more pair is refused without need.
constexpr double kSlopeTolerance = 1e-12;

/// A common normal in the axes of the world. Points are relative to the origins of their bodies' frames.
struct WorldNormal {
  Vector3 n;
  std::array<Vector3, 2> t;  // the basis of the tangent plane
  Vector3 p1, p2;            // m; the witness points
  double s;                  // m
};

/// [p] M, where [p] w = p x w.
TwistJacobian cross_times(const Vector3& p, const TwistJacobian& M) { return -M.colwise().cross(p); }

/// The motion of a point p of the body: v + w x p.
void add_rigid(const Vector3& p, int v, TwistJacobian& J) {
  const int w = v + 3;
  for (int i = 0; i < 3; ++i) J(i, v + i) += 1;
  J(0, w + 1) += p.z();
  J(0, w + 2) -= p.y();
  J(1, w) -= p.z();
  J(1, w + 2) += p.x();
  J(2, w) += p.y();
  J(2, w + 1) -= p.x();
}

/// n.(w x (w x p)), the second derivative at a fixed normal.
void add_rotation(const Vector3& n, const Vector3& p, double sign, int w, TwistHessian& H) {
  const Vector3 half = 0.5 * sign * p;
  H.block<3, 3>(w, w) += half * n.transpose() + n * half.transpose();
  H.block<3, 3>(w, w).diagonal().array() -= sign * p.dot(n);
}

/// The derivatives of a common normal, its witness points and the gradient of the gap.
///
/// A point that follows the motion of its body differs from the witness point by H times the tilt of the normal in the frame of the
/// body. In the frame of body 1 only the relative motion counts, so H1 times the tilt has no difference of large numbers, as flat
/// as body 1 may be; the same holds for body 2.
void write_jacobians(const TangentResponse& response, const WorldNormal& at, const DerivativeSettings& settings,
                     ProximityDerivatives& out) {
  const Vector3 &t1 = at.t[0], &t2 = at.t[1];
  const Matrix2 follow1 = response.B1.transpose(), follow2 = response.B2.transpose(), turn_back = response.W.transpose();
  // A rotation w of a body moves its point p along t by t.(w x p) = (p x t).w.
  const Vector3 tilt1 = at.n.cross(t1), tilt2 = at.n.cross(t2);
  const Vector3 first1 = at.p1.cross(t1), first2 = at.p1.cross(t2), second1 = at.p2.cross(t1), second2 = at.p2.cross(t2);
  const auto lift = [&](const Vector2& u) -> Vector3 { return u.x() * t1 + u.y() * t2; };
  for (int i = 0; i < 3; ++i) {
    const Vector2 along(t1[i], t2[i]), tilt(tilt1[i], tilt2[i]), first(first1[i], first2[i]), second(second1[i], second2[i]);
    const Vector2 turn1 = response.W * tilt, turn2 = turn_back * tilt;
    out.normal.col(kV2 + i) = lift(response.G * along);
    out.normal.col(kV1 + i) = -out.normal.col(kV2 + i);
    out.normal.col(kW1 + i) = lift(response.B1 * tilt - response.G * first);
    out.normal.col(kW2 + i) = lift(response.B2 * tilt + response.G * second);
    // The points without the motion of their body. Point 2 is opposite a place on body 1, and point 1 one on body 2.
    out.point1.col(kV2 + i) = lift(follow1 * along);
    out.point1.col(kV1 + i) = -out.point1.col(kV2 + i);
    out.point1.col(kW1 + i) = -lift(follow1 * (first + at.s * tilt) + turn1);
    out.point1.col(kW2 + i) = lift(follow1 * second + turn1);
    out.point2.col(kV1 + i) = lift(follow2 * along);
    out.point2.col(kV2 + i) = -out.point2.col(kV1 + i);
    out.point2.col(kW1 + i) = lift(follow2 * first - turn2);
    out.point2.col(kW2 + i) = -lift(follow2 * (second - at.s * tilt) - turn2);
  }
  if (settings.hessian) {
    // The derivative of the gradient. The second derivative along a rotation vector w of exp([w]) R is its symmetric part.
    TwistHessian& H = out.gap_hessian;
    H.middleRows<3>(kV1) = -out.normal;
    H.middleRows<3>(kV2) = out.normal;
    H.middleRows<3>(kW1) = cross_times(at.n, out.point1) - cross_times(at.p1, out.normal);
    H.middleRows<3>(kW2) = cross_times(at.p2, out.normal) - cross_times(at.n, out.point2);
    add_rotation(at.n, at.p1, -1, kW1, H);
    add_rotation(at.n, at.p2, 1, kW2, H);
    for (int i = 0; i < 12; ++i) {
      for (int j = 0; j < i; ++j) H(i, j) = H(j, i) = 0.5 * (H(i, j) + H(j, i));
    }
  }
  add_rigid(at.p1, kV1, out.point1);
  add_rigid(at.p2, kV2, out.point2);
}

/// Whether the opposite normal has the same gap. For symmetric bodies s(-n) = s(n) - 2 n.c; others take an evaluation.
bool has_equal_opposite(GapFunction& gap, const CommonNormal& common) {
  if (!(common.gap() < 0)) return false;
  double above = -2 * common.normal().dot(gap.offset());
  if (!gap.traits1().is_symmetric || !gap.traits2().is_symmetric) {
    GapJet opposite;
    gap.evaluate(-common.normal(), Order::Value, opposite);
    above = opposite.s - common.gap();
  }
  return std::abs(above) <= 4 * gap.rounding();
}

DerivativeStatus status_of(GapFunction& gap, const CommonNormal& common) {
  using Kind = TangentResponse::Kind;
  if (!common.is_converged()) return DerivativeStatus::NotConverged;
  if (common.response().kind == Kind::Singular) return DerivativeStatus::SingularCurvature;
  if (has_equal_opposite(gap, common)) return DerivativeStatus::SeveralMaxima;
  // Free only at this normal, or so it seems.
  if (!common.is_strict() || common.response().kind == Kind::Free) return DerivativeStatus::Degenerate;
  return common.has_active_set() ? DerivativeStatus::ActiveSet : DerivativeStatus::Smooth;
}

/// Tilts along both directions of a tangent plane, both ways. Their square holds all tilts by kNearby.
std::array<Vector2, 4> tilts_nearby() {
  constexpr double kTilt = std::numbers::sqrt2 * kNearby;
  return {Vector2(kTilt, 0), Vector2(-kTilt, 0), Vector2(0, kTilt), Vector2(0, -kTilt)};
}

/// What a rotation by kNearby does that the derivatives do not say.
enum class Departure { None, Bend, Jump };

/// `moved`: how far a point has moved (m); `foreseen`: by its derivative; `size`: of the smaller body (m).
Departure departure_of(const Vector3& moved, const Vector3& foreseen, double size) {
  if ((moved - foreseen).norm() <= std::max(kBend * foreseen.norm(), kLeastBend * size)) return Departure::None;
  return moved.norm() > kJump * size ? Departure::Jump : Departure::Bend;
}

void set_flags(ProximityDerivatives& out) {
  const bool is_regular = out.status == DerivativeStatus::Smooth || out.status == DerivativeStatus::ActiveSet;
  out.has_normal = out.has_points = is_regular;
  out.has_gap = is_regular || out.status == DerivativeStatus::Degenerate || out.status == DerivativeStatus::NoHessian;
}

void set_status(Departure departure, ProximityDerivatives& out) {
  if (departure == Departure::Jump) out.status = DerivativeStatus::FreeOnFace;
  if (departure == Departure::Bend) out.status = DerivativeStatus::Degenerate;
  set_flags(out);
}

/// Whether a query has ended near a common normal.
bool is_answer(const Proximity& proximity) {
  return proximity.status != Status::InvalidInput && proximity.status != Status::Apart && proximity.status != Status::Diverged;
}

void add_parameters(const GapFunction& gap, const Vector3& n, const Vector3& point1, const Vector3& lever2,
                    ProximityDerivatives& out) {
  const Matrix3 to_body2 = gap.rotation().transpose();
  gap.shape1().add_parameter_gradient(n, point1, out.parameters1);
  gap.shape2().add_parameter_gradient(-(to_body2 * n), to_body2 * lever2, out.parameters2);
  out.parameters1.scale(-1);
  out.parameters2.scale(-1);
}

/// A motion of body 2, in body 1's frame: by w about its witness point, and by v across the normal.
struct Motion {
  Vector3 v, w;
};

/// How a common normal changes by a motion, and witness point 2 beyond the motion itself, by the formulas of write_jacobians().
struct Change {
  Vector3 normal, point;

  Change(const CommonNormal& common, const Motion& motion) {
    const TangentResponse& response = common.response();
    const TangentPlane& plane = common.plane();
    const Vector2 tilt = plane.project(motion.w.cross(common.normal())), shift = plane.project(motion.v);
    normal = plane.lift(response.G * shift + response.B2 * tilt);
    point = plane.lift(response.W.transpose() * tilt - response.B2.transpose() * (shift - common.gap() * tilt));
  }
};

/// Whether the Jacobians at two poses that are nearly the same are so, too.
bool has_same_jacobians(const CommonNormal& common, const CommonNormal& found, double largest) {
  if (common.response().kind != TangentResponse::Kind::Regular) return true;  // there are none
  return found.is_strict() && common.response().is_near(common.plane(), found.response(), found.plane(), kBend, largest);
}

/// What a motion of body 2 does. Newton's method finds the common normal there, from what the derivatives foresee. Where it ends
/// without one, or on flat sides where its step is not defined, a query tells whether the gap has a kink.
Departure look_at(const GapFunction& gap, const CommonNormal& common, const Motion& motion, int& evaluations) {
  const double size1 = gap.shape1().half_extents().norm(), size2 = gap.shape2().half_extents().norm(),
               size = std::min(size1, size2);
  const double angle = motion.w.norm();
  const Matrix3 turn = Eigen::AngleAxisd(angle, motion.w / angle).toRotationMatrix();
  const Vector3 lever = turn * common.lever2();
  const Pose there{gap.offset() + common.lever2() + motion.v - lever, turn * gap.rotation()};
  const Change foreseen(common, motion);
  const auto is_known = [](const CommonNormal& found) {
    return found.is_converged() && found.response().kind != TangentResponse::Kind::Free;
  };
  const auto compared = [&](const CommonNormal& found) {
    return std::max({departure_of(found.lever2() - lever, foreseen.point, size),
                     departure_of(size * (found.normal() - common.normal()), size * foreseen.normal, size),
                     has_same_jacobians(common, found, std::max(size1, size2)) ? Departure::None : Departure::Bend});
  };
  GapFunction gap_there(gap.shape1(), {}, gap.shape2(), there);
  const CommonNormal found(gap_there, (common.normal() + foreseen.normal).normalized());
  evaluations += gap_there.evaluations();
  if (is_known(found)) return compared(found);
  const Vector3 first = common.normal();
  Settings exact;
  exact.tolerance = kSlopeTolerance;
  const Proximity answer = find_proximity(gap.shape1(), {}, gap.shape2(), there, exact, &first);
  evaluations += answer.evaluations;
  if (answer.status != Status::Converged) return Departure::Jump;
  GapFunction gap_again(gap.shape1(), {}, gap.shape2(), there);
  const CommonNormal again(gap_again, answer.normal);
  evaluations += gap_again.evaluations();
  if (is_known(again)) return compared(again);
  // The motion is across the normal at the witness point, so the gap changes to second order, if it has no kink.
  const Vector3 axis = motion.w / angle;
  const double change = 2 * (answer.gap - common.gap()) / angle;
  const double second = (foreseen.normal.dot(motion.v) + foreseen.point.cross(common.normal()).dot(motion.w)) / angle;
  const Departure unconfirmed = common.response().kind == TangentResponse::Kind::Regular ? Departure::Bend : Departure::None;
  return std::max(departure_of(change * axis, second * axis, size), unconfirmed);
}

/// m; the radii of curvature, none larger than the body: a rotation moves no point by more than that times its angle.
Symmetric2 bounded(const Symmetric2& A, const Shape& shape) {
  const double size = shape.half_extents().norm();
  if (A.trace() <= size) return A;
  const double part = size / A.trace();
  return {part * A.xx, part * A.xy, part * A.yy};
}

/// Rolls the witness points of both bodies by kNearby and a little more. First body 2 keeps its boundary point and rolls about body
/// 1's centre of curvature, then body 1 keeps its own. A witness point on an edge or a face slides by as much as the other body's
/// point moves. Between sharp points, whose centres are near, a rotation of a body moves them by its size times the angle.
Departure look_nearby(const GapFunction& gap, const CommonNormal& common, int& evaluations) {
  const double size = std::min(gap.shape1().half_extents().norm(), gap.shape2().half_extents().norm());
  const double apart = common.is_sharp() ? std::max(common.gap(), size) : common.gap();
  const Symmetric2 roll1 = bounded(common.radii1(), gap.shape1()).plus_identity(apart),
                   roll2 = bounded(common.radii2(), gap.shape2());
  const TangentPlane& plane = common.plane();
  Departure worst = Departure::None;
  for (const Vector2& tilt : tilts_nearby()) {
    const Vector3 w = plane.n.cross(plane.lift(tilt));
    for (const Vector2& shift : {Vector2(roll1 * tilt), Vector2(-(roll2 * tilt))}) {
      worst = std::max(worst, look_at(gap, common, {plane.lift(shift), w}, evaluations));
      if (worst == Departure::Jump) return worst;
    }
  }
  return worst;
}

/// The same for a body on a plane, whose boundary point r moves by its radii of curvature times the tilt. Four evaluations, but
/// none unless the body may be flat.
Departure look_nearby(const Shape& shape, const TangentPlane& tangent, const Vector3& r, const BodyCurvature& body) {
  const double size = shape.half_extents().norm();
  Departure worst = Departure::None;
  if (!shape.traits().has_nonsmooth_points && !body.may_be_flat(size)) return worst;
  for (const Vector2& tilt : tilts_nearby()) {
    const Vector3 moved = shape.point((tangent.n + tangent.lift(tilt)).normalized()) - r;
    worst = std::max(worst, departure_of(moved, tangent.lift(body.A * tilt), size));
  }
  return worst;
}

/// All derivatives, or no Jacobians.
enum class Extent { Gradient, All };

ProximityDerivatives derivatives_of(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                    const Proximity& proximity, const DerivativeSettings& settings, Extent extent) {
  ProximityDerivatives out;
  if (!is_usable(pose1) || !is_usable(pose2) || !all_finite(proximity.normal) || proximity.status == Status::InvalidInput)
    return out;
  out.common_normal = proximity.normal;
  out.status = DerivativeStatus::NotConverged;
  if (!is_answer(proximity)) return out;
  GapFunction gap(shape1, pose1, shape2, pose2);
  if (!gap.is_finite()) return out;
  const Vector3 start = (pose1.rotation.transpose() * proximity.normal).normalized();
  if (!gap.has_hessian()) {
    out.status = DerivativeStatus::NoHessian;
    out.gap_gradient = gradient_of_answer(pose1, pose2, proximity);
    set_flags(out);
    if (settings.parameters)
      add_parameters(gap, start, shape1.point(start), gap.rotation() * shape2.point(-(gap.rotation().transpose() * start)), out);
    return out;
  }

  const CommonNormal common(gap, start);
  out.status = status_of(gap, common);
  out.evaluations = gap.evaluations();
  set_flags(out);
  if (out.has_gap && common.may_change_nearby()) set_status(look_nearby(gap, common, out.evaluations), out);
  const Matrix3& R = pose1.rotation;
  const WorldNormal at{
      R * common.normal(), {R * common.plane().t1, R * common.plane().t2}, R * common.point1(), R * common.lever2(), common.gap()};
  out.common_normal = at.n;
  out.gap_gradient = gradient_of(at.n, at.p1, at.p2);
  if (settings.parameters) add_parameters(gap, common.normal(), common.point1(), common.lever2(), out);
  if (out.has_normal && extent == Extent::All) write_jacobians(common.response(), at, settings, out);
  return out;
}

}  // namespace

GapGradient find_gap_gradient(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                              const Proximity& proximity) {
  constexpr DerivativeSettings kNoMore{.hessian = false, .parameters = false};
  const ProximityDerivatives found = derivatives_of(shape1, pose1, shape2, pose2, proximity, kNoMore, Extent::Gradient);
  return {found.status, found.has_gap, found.gap_gradient, found.evaluations};
}

ProximityDerivatives find_proximity_derivatives(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                                const Proximity& proximity, const DerivativeSettings& settings) {
  return derivatives_of(shape1, pose1, shape2, pose2, proximity, settings, Extent::All);
}

// The plane is a face of body 2 that has no border: the normal rotates with it, and its radii of curvature are infinite.
ProximityDerivatives find_plane_derivatives(const Shape& shape, const Pose& pose, const Vector3& plane_normal, double plane_offset,
                                            const DerivativeSettings& settings) {
  ProximityDerivatives out;
  const Proximity answer = find_plane_proximity(shape, pose, plane_normal, plane_offset);
  if (answer.status == Status::InvalidInput) return out;
  out.common_normal = answer.normal;
  out.gap_gradient = gradient_of_answer(pose, {}, answer);
  const Vector3 own = pose.rotation.transpose() * answer.normal;
  Jet jet;
  shape.evaluate(own, shape.traits().has_hessian ? Order::Hessian : Order::Point, jet);
  if (settings.parameters) {
    shape.add_parameter_gradient(own, jet.r, out.parameters1);
    out.parameters1.scale(-1);
  }
  const double unit = shape.half_extents().minCoeff();
  BodyCurvature body, plane;
  out.status = DerivativeStatus::NoHessian;
  if (shape.traits().has_hessian) {
    if (!all_finite(jet.H)) return {};
    const TangentPlane tangent = TangentPlane::along_flattest(own, jet.H);
    body.A = Symmetric2::project(tangent, jet.H);
    out.status = body.A.trace() > limits::kFlattest * unit ? DerivativeStatus::Degenerate : DerivativeStatus::Smooth;
    set_status(look_nearby(shape, tangent, jet.r, body), out);
    if (!out.has_normal) return out;
    plane.flatten(Vector2::UnitX());
    plane.flatten(Vector2::UnitY());
    const WorldNormal at{answer.normal,
                         {pose.rotation * tangent.t1, pose.rotation * tangent.t2},
                         answer.point1 - pose.position,
                         answer.point2,
                         answer.gap};
    write_jacobians(TangentResponse::of(body, plane, answer.gap, unit), at, settings, out);
  }
  set_flags(out);
  return out;
}

}  // namespace supernormal
