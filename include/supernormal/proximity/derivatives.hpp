// How the gap, the common normal and the witness points change as the bodies move or change their shape.
#pragma once

#include <Eigen/Core>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/parameter_gradient.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A number for each component of the two bodies' twists: (v1, w1, v2, w2), three each. A twist moves body i to the position
/// p_i + v_i and the orientation exp([w_i]) R_i: it acts at the origin of the body's frame, along the axes of the world. v is in m,
/// w in rad. Like the two types below it is not aligned: Eigen's alignment, and so the layout of ProximityDerivatives, would depend
/// on the instructions that a program is compiled for (-mavx).
using TwistVector = Eigen::Matrix<double, 12, 1, Eigen::DontAlign>;

/// A vector for each component of the two twists.
using TwistJacobian = Eigen::Matrix<double, 3, 12, Eigen::DontAlign>;

/// Second derivatives with respect to both twists.
using TwistHessian = Eigen::Matrix<double, 12, 12, Eigen::DontAlign>;

/// Why a derivative exists or not.
enum class DerivativeStatus {
  Smooth,     ///< all derivatives are defined
  ActiveSet,  ///< defined while the witness points stay on their face, edge or vertex, because all multipliers are positive
  /// A witness point is at the border of its face or edge, or a body is flat at this point only: the gradient is defined, the
  /// others are one-sided, or change by a tenth and more within 1e-6 rad: as the normal rotates by so much on either body, or the
  /// point slides by so much of the other body's radius of curvature. Or a radius has no digits beside a very large one.
  Degenerate,
  /// Faces, flat sides or edges share more than a point, or do so after a rotation of 1e-6 rad, so that the gap has a kink: the
  /// witness points and the gradient of rotations are not unique.
  FreeOnFace,
  /// H1 + H2 + gap is singular across the normal (vertex to vertex), or below 1e-6 half-extents: the normal may not be unique
  SingularCurvature,
  SeveralMaxima,  ///< the opposite normal has the same gap: the gap is not differentiable
  /// A shape has no Hessian: only the gradient of the gap is known, as exactly as the normal and the points of the answer.
  NoHessian,
  NotConverged,  ///< the answer's normal is not a common normal
  InvalidInput,  ///< a pose is not usable, or a number is not finite
};

/// The gradient of the gap with respect to the twists: (-n, -P1 x n, n, P2 x n) with the witness points P1 and P2 relative to the
/// origins of their bodies' frames. So the derivative with respect to the position of body 2 is the normal. By the envelope theorem
/// the change of the normal has no effect to first order (Danskin 1966; lib/proximity/README.md).
struct GapGradient {
  DerivativeStatus status = DerivativeStatus::InvalidInput;  ///< says why has_gap is false
  bool has_gap = false;                        ///< whether it is the gradient; otherwise one of the subgradients, or zero
  TwistVector gradient = TwistVector::Zero();  ///< per m and per rad: m/m and m/rad
  int evaluations = 0;                         ///< of the gap function
};

/// The status, the gradient and the evaluations of find_proximity_derivatives(), digit by digit, without the Jacobians.
///
/// The points of an answer are not enough: a gap that is exact to 1e-9 leaves the normal of a flat side uncertain by so much that
/// its point may be anywhere on the side. So Newton's method brings the normal to rounding first.
SUPERNORMAL_API GapGradient find_gap_gradient(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                              const Proximity& proximity);

/// What find_proximity_derivatives() computes besides the first derivatives with respect to the twists.
struct DerivativeSettings {
  bool hessian = true;     ///< ProximityDerivatives::gap_hessian
  bool parameters = true;  ///< ProximityDerivatives::parameters1 and parameters2
};

/// Derivatives at a common normal, in the world frame. A member whose flag is false is zero, except the gradient of the gap.
/// Nothing is NaN.
struct ProximityDerivatives {
  DerivativeStatus status = DerivativeStatus::InvalidInput;  ///< says why a flag is false
  bool has_gap = false;     ///< whether the gap is differentiable; otherwise gap_gradient is one of its subgradients, or zero
  bool has_normal = false;  ///< whether the normal is differentiable, and the gap twice
  bool has_points = false;  ///< whether the witness points are differentiable
  TwistVector gap_gradient = TwistVector::Zero();            ///< per m and per rad: m/m and m/rad
  TwistJacobian normal = TwistJacobian::Zero();              ///< 1/m and 1/rad
  TwistJacobian point1 = TwistJacobian::Zero();              ///< m/m and m/rad; the point of space, not of the material
  TwistJacobian point2 = TwistJacobian::Zero();              ///< m/m and m/rad
  TwistHessian gap_hessian = TwistHessian::Zero();           ///< m/(m m), m/(m rad) and m/(rad rad); symmetric
  ParameterGradient parameters1;                             ///< d gap / d parameter of shape 1, in the order of its class
  ParameterGradient parameters2;                             ///< d gap / d parameter of shape 2
  Eigen::Vector3d common_normal = Eigen::Vector3d::UnitX();  ///< unit; the normal of the answer after Newton's last steps
  int evaluations = 0;                                       ///< of the gap function
};

/// The derivatives of the answer `proximity` of find_proximity() with the same shapes and poses. All are closed forms: implicit
/// differentiation of the condition that the witness points' difference is parallel to the normal. For an overlap they belong to
/// the local maximum of the answer. Where bodies have faces or edges the set of active vertices is kept, so the derivatives are
/// exact while the contact stays on its face, edge or vertex.
///
/// Newton's method first brings the answer's normal to rounding, with two evaluations as a rule and at most 32. Where both bodies
/// may be flat, a point is near the border of a face, or both bodies are sharp, eight poses are solved, too, in which the witness
/// point of either body has rolled by 1e-6 rad: the status says whether the Jacobians there are the same. All is computed in body
/// 1's frame, so a large distance from the world's origin costs no digits.
///
/// The relative error is about 1e-7 or less, as long as the radii of curvature of the Minkowski difference differ by less than 1e9.
/// Within some 1e-9 rad of the axis of a superellipsoid, where a radius is zero or infinite, it is as much as a rotation by
/// rounding changes. A radius of curvature above 1e8 times the smallest half-extent counts as infinite. Beside a radius above about
/// 1e10 half-extents, a LinearImage or a Superovoid may not tell the other radius to 1e-6: the status is Degenerate. It is so, too,
/// if Newton's method ends where these derivatives still change by 1e-6.
SUPERNORMAL_API ProximityDerivatives find_proximity_derivatives(const Shape& shape1, const Pose& pose1, const Shape& shape2,
                                                                const Pose& pose2, const Proximity& proximity,
                                                                const DerivativeSettings& settings = {});

/// The derivatives of find_plane_proximity(). Body 2 is the half-space, and the origin of its frame the origin of the world: its
/// twist moves the plane by v2 and rotates it about this origin by w2. Nothing is iterated, and `evaluations` is 0. The status is
/// FreeOnFace if an edge or a face of the body lies on the plane, or does so after a rotation of 1e-6 rad. plane_normal and
/// plane_offset as in find_plane_proximity().
SUPERNORMAL_API ProximityDerivatives find_plane_derivatives(const Shape& shape, const Pose& pose, const Vector3& plane_normal,
                                                            double plane_offset, const DerivativeSettings& settings = {});

}  // namespace supernormal
