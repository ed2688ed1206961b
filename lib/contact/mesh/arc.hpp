// Support points of a body, and a body over a convex edge. There the one unknown is the angle of the normal between the normals of
// the two faces.
#pragma once

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The point of the body farthest against a normal of the surface: the deepest point over a plane with this normal.
struct DeepestPoint {
  Vector3 point;      ///< m
  double height = 0;  ///< m; normal . point
};

/// Evaluates support points and counts the evaluations. The frame has the axes of the world and the origin of the body. So a large
/// distance from the world's origin costs no digits, and the normals of a level floor stay exact.
class SupportProbe {
 public:
  SupportProbe(const Shape& shape, const Matrix3& rotation) : shape_(&shape), rotation_(rotation) {}

  /// `normal`: unit, out of the surface. Does the operations of find_plane_proximity() in the same order, for equal digits.
  DeepestPoint deepest(const Vector3& normal) {
    Jet jet;
    shape_->evaluate(-(rotation_.transpose() * normal), Order::Point, jet);
    ++evaluations_;
    return {rotation_ * jet.r, -jet.h};
  }

  const Shape& shape() const { return *shape_; }
  const Matrix3& rotation() const { return rotation_; }

  int evaluations() const { return evaluations_; }
  void count(int evaluations) { evaluations_ += evaluations; }

 private:
  const Shape* shape_;
  Matrix3 rotation_;
  int evaluations_ = 0;
};

/// The gap at one normal of the arc, and its slope.
struct ArcSample {
  double angle = 0;
  double slope = 0;                 ///< m/rad; how far the body's point is beyond the edge, across the normal
  double gap = 0;                   ///< m; normal . (point - edge_point)
  Vector3 point = Vector3::Zero();  ///< m; the support point of the body for this normal
};

/// The normals n(angle) = cos(angle) from + sin(angle) towards of an edge through `edge_point`, 0 <= angle <= end.
struct Arc {
  Vector3 from = Vector3::UnitX();     ///< unit: the normal of one face
  Vector3 towards = Vector3::UnitY();  ///< unit, perpendicular to `from` and the edge: out of that face
  double end = 0;                      ///< radians, in (0, pi]
  Vector3 edge_point = Vector3::Zero();

  Vector3 normal(double angle) const;

  /// A sample with the known support point of the body.
  ArcSample sample(double angle, const Vector3& point) const;

  /// A sample that evaluates the body.
  ArcSample sample(double angle, SupportProbe& probe) const;
};

/// The result of maximize_between(). If `is_apart`, the other fields are invalid.
struct ArcMaximum {
  bool is_apart = true;
  bool converged = false;
  Vector3 normal = Vector3::UnitX();
  Vector3 point = Vector3::Zero();  ///< m; point of the body over the edge
  double gap = 0;                   ///< m; normal . (point - edge_point)
  double error = 0;                 ///< m; upper bound of the missing gap
};

/// Whether there is a maximum between two samples, `low` at the smaller angle: the gap increases from both, or from the higher one.
/// Slopes within `level` (m/rad) count as 0.
bool have_maximum_between(const ArcSample& low, const ArcSample& high, double level);

/// Finds such a maximum, at least as high as both samples to the tolerance. Stops at the first normal that separates the bodies.
/// `tolerance`: of the gap, m.
ArcMaximum maximize_between(SupportProbe& probe, const Arc& arc, ArcSample low, ArcSample high, double tolerance,
                            int max_evaluations);

/// Searches the whole arc from `low` to `high` for a normal with a gap above `known` (m). If there is one, `low` and `high` become
/// the samples around the highest, ready for maximize_between(). A gap less than `tolerance` (m) higher does not count.
///
/// Every point of the body bounds the gap from above for all normals: gap(n) <= n . (point - edge_point). The lower of the bounds
/// of two adjacent samples rules out most arcs without another evaluation. Otherwise its maximum is the next angle to evaluate.
bool find_higher_maximum(SupportProbe& probe, const Arc& arc, ArcSample& low, ArcSample& high, double known, double tolerance);

}  // namespace supernormal
