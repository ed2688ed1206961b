// A body over a convex edge: one unknown, the angle of the normal between those of the two faces.
#pragma once

#include "contact/mesh/support_probe.hpp"

namespace supernormal {

/// The gap for one of the normals, and its slope.
struct ArcSample {
  double angle = 0;
  double slope = 0;                 ///< m per radian; how far the body's point is beyond the edge, seen along the normal
  double gap = 0;                   ///< m; normal . (point - edge_point)
  Vector3 point = Vector3::Zero();  ///< m; the body's deepest with this normal
};

/// The normals n(angle) = cos(angle) from + sin(angle) towards of an edge through `edge_point`, 0 <= angle <= end.
struct Arc {
  Vector3 from = Vector3::UnitX();     ///< unit: the normal of one face
  Vector3 towards = Vector3::UnitY();  ///< unit, perpendicular to `from` and the edge: out of that face
  double end = 0;                      ///< radians, in (0, pi]
  Vector3 edge_point = Vector3::Zero();

  Vector3 normal(double angle) const;

  /// When the body's deepest point with that normal is known.
  ArcSample sample(double angle, const Vector3& point) const;

  /// Evaluates the body.
  ArcSample sample(double angle, SupportProbe& probe) const;
};

/// When the bodies are apart, nothing else is known.
struct ArcMaximum {
  bool is_apart = true;
  bool converged = false;
  Vector3 normal = Vector3::UnitX();
  Vector3 point = Vector3::Zero();  ///< m; of the body, over the edge
  double gap = 0;                   ///< m; normal . (point - edge_point)
  double error = 0;                 ///< m; by which the gap may be too small
};

/// Whether two samples, `low` at the smaller angle, tell of a maximum between them: the gap rises from both, or it rises from the
/// higher one. Slopes within `level` (m per radian) are none.
bool have_maximum_between(const ArcSample& low, const ArcSample& high, double level);

/// That maximum; one of them where there are several. Ends at the first normal that separates the bodies. `tolerance` in m, of the
/// gap.
ArcMaximum maximize_between(SupportProbe& probe, const Arc& arc, ArcSample low, ArcSample high, double tolerance,
                            int max_evaluations);

}  // namespace supernormal
