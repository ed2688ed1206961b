// The gap function of two bodies, which every solver maximises.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

class Superellipsoid;

/// s and its derivatives at one normal, in body 1's frame.
struct SUPERNORMAL_API GapJet {
  Vector3 n = Vector3::UnitX();   ///< the unit normal of the evaluation
  double s = 0;                   ///< m; s(n) = n.c - h1(n) - h2(-n)
  Vector3 d = Vector3::Zero();    ///< m; gradient of s: point2 - point1; s = n.d
  Vector3 m = -Vector3::UnitX();  ///< -n in body 2's frame
  Jet jet1;                       ///< of body 1, in its frame
  Jet jet2;                       ///< of body 2, in its frame, for the normal m

  /// Whether s and d are finite. A shape may return values that are not.
  bool is_finite() const;
};

/// s(n) = n.c - h1(n) - h2(-R^T n): the gap between the supporting planes of the two bodies with normal n. Its maximum over the
/// unit sphere is the signed gap (lib/proximity/README.md). All quantities are in body 1's frame, so a large distance from the
/// world's origin costs no digits. Counts its evaluations. Holds references to the shapes.
class SUPERNORMAL_API GapFunction {
 public:
  /// The gap function of two bodies; both poses are in the same frame.
  GapFunction(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2);

  /// Evaluates at the unit normal n (body 1's frame) and counts one evaluation.
  void evaluate(const Vector3& n, Order order, GapJet& jet);

  /// H1 + H2, the negative Hessian of s, m. `jet` must have been evaluated with Order::Hessian.
  Matrix3 curvature(const GapJet& jet) const { return jet.jet1.H + rotation_ * jet.jet2.H * rotation_.transpose(); }

  int evaluations() const { return evaluations_; }  ///< how often evaluate() was called, and what was counted before
  void count_earlier(int evaluations) { evaluations_ += evaluations; }  ///< counts evaluations that were made elsewhere
  const Shape& shape1() const { return *shape1_; }                      ///< body 1
  const Shape& shape2() const { return *shape2_; }                      ///< body 2
  const ShapeTraits& traits1() const { return traits1_; }               ///< of body 1
  const ShapeTraits& traits2() const { return traits2_; }               ///< of body 2

  /// Centre 2 - centre 1, m, in body 1's frame.
  const Vector3& offset() const { return offset_; }
  /// The orientation of body 2 in body 1's frame.
  const Matrix3& rotation() const { return rotation_; }

  /// m; the unit of length of tolerances: the smallest half-extent of the bodies that are not points.
  double length_unit() const { return length_unit_; }

  /// m; the radius of a ball that rolls inside the Minkowski difference of the bodies: the sum of their Shape::rolling_radius. s +
  /// radius is the gap function of the Minkowski difference without the ball.
  double rolling_radius() const { return shape1_->rolling_radius() + shape2_->rolling_radius(); }

  /// m; the unavoidable rounding error of s.
  double rounding() const { return rounding_; }

  /// Whether both shapes deliver Order::Hessian.
  bool has_hessian() const { return traits1_.has_hessian && traits2_.has_hessian; }

  bool is_finite() const;  ///< whether the poses and the sizes of the shapes are finite

 private:
  const Shape* shape1_;
  const Shape* shape2_;
  ShapeTraits traits1_, traits2_;
  const Superellipsoid* superellipsoid1_;  // null if body 1 is of another class
  const Superellipsoid* superellipsoid2_;
  Vector3 offset_;
  Matrix3 rotation_;
  double length_unit_;
  double rounding_;
  int evaluations_ = 0;
};

}  // namespace supernormal
