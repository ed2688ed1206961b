// A body over a convex edge: one unknown, the angle of the normal between those of the two faces.
#pragma once

#include "contact/mesh/support_probe.hpp"

namespace supernormal {

/// The gap for one normal of the arc, and its slope.
struct ArcSample {
  double angle = 0;
  double slope = 0;                 ///< m per radian; how far the body's point is beyond the edge, seen along the normal
  double gap = 0;                   ///< m; normal . (point - edge_point)
  Vector3 point = Vector3::Zero();  ///< m; the deepest point of the body with this normal
};

/// The normals n(angle) = cos(angle) from + sin(angle) towards of an edge through `edge_point`, 0 <= angle <= end.
struct Arc {
  Vector3 from = Vector3::UnitX();     ///< unit: the normal of one face
  Vector3 towards = Vector3::UnitY();  ///< unit, perpendicular to `from` and the edge: out of that face
  double end = 0;                      ///< radians, in (0, pi]
  Vector3 edge_point = Vector3::Zero();

  Vector3 normal(double angle) const;

  /// A sample for which the body's deepest point with that normal is known.
  ArcSample sample(double angle, const Vector3& point) const;

  /// A sample that evaluates the body.
  ArcSample sample(double angle, SupportProbe& probe) const;
};

/// The result of maximize_between(). When the bodies are apart, nothing else in it is valid.
struct ArcMaximum {
  bool is_apart = true;
  bool converged = false;
  Vector3 normal = Vector3::UnitX();
  Vector3 point = Vector3::Zero();  ///< m; point of the body, over the edge
  double gap = 0;                   ///< m; normal . (point - edge_point)
  double error = 0;                 ///< m; bound on how much too small the gap may be
};

/// Whether two samples, `low` at the smaller angle, tell of a maximum between them: the gap rises from both, or it rises from the
/// higher one. Slopes within `level` (m per radian) count as 0.
bool have_maximum_between(const ArcSample& low, const ArcSample& high, double level);

/// Finds that maximum, or one of them where there are several: one that is as high as either sample, to the tolerance. Ends at the
/// first normal that separates the bodies. `tolerance` of the gap in m.
ArcMaximum maximize_between(SupportProbe& probe, const Arc& arc, ArcSample low, ArcSample high, double tolerance,
                            int max_evaluations);

}  // namespace supernormal
