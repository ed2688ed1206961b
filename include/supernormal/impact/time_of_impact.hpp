// When two bodies that move will meet.
#pragma once

#include "supernormal/impact/motion.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// s; no search goes farther.
inline constexpr double kMaxHorizon = 1e30;

/// How the search for an impact ended.
enum class ImpactStatus {
  Apart,         ///< no impact until the horizon: proved
  Hits,          ///< the gap comes within the tolerance at Impact::time, and not before: proved
  Overlapping,   ///< the bodies overlap by more than the tolerance at time 0
  NotConverged,  ///< a limit was reached, or a query has stalled; there is no impact before Impact::apart_until
  InvalidInput,  ///< a motion or a shape gave a number that is not finite, or a rotation is none; the result holds no answer
};

/// The first impact of two bodies that move, or the proof that there is none.
struct Impact {
  ImpactStatus status = ImpactStatus::InvalidInput;  ///< how the search ended
  double time = 0;         ///< s; of the impact; 0 for an overlap; the horizon if there is none; apart_until if not converged
  double apart_until = 0;  ///< s; the gap is positive before this time, but for a touch at time 0 out of which the bodies part
  /// At `time`, in the frame of the poses: normal from body 1 to body 2, witness points and contact. For bodies apart it is a
  /// normal that proves it, with Status::Apart: the gap is `gap` or more.
  Proximity proximity;
  int evaluations = 0;  ///< of the gap function; of a body and a plane, of the support function

  /// Whether there is an impact, or none is excluded.
  bool may_hit() const { return status != ImpactStatus::Apart; }
};

/// Finds the first time in [0, horizon] at which two bodies in steady motion meet, to the tolerance: Settings::tolerance times the
/// smallest half-extent of the two, but no less than rounding of the places that they pass until they meet (lib/impact/README.md).
///
/// At the time of an impact the gap is in [0, tolerance], to rounding, and a gap below half of the tolerance is an impact. None is
/// missed, however fast the bodies turn: that they are apart is proved for every time before, and not sampled. Bodies that touch at
/// time 0, with a gap of either sign within half of the tolerance, hit at 0, unless it is proved that they part: that they are
/// apart at a later time, and until then overlap by no more than the tolerance. The search goes on from there.
///
/// `first_normal` (unit, in body 1's frame, or null) is where the first query starts: a normal of an earlier, similar pose.
///
/// `horizon` in s, in [0, kMaxHorizon]. Of the settings, `tolerance`, `solver` and `max_evaluations` are used, the latter as the
/// limit of each query and of their number. Throws std::invalid_argument when one of these is out of range;
/// ImpactStatus::InvalidInput when a number of a motion, or the angle that a body turns, is not within kMaxMotion, a rotation is
/// none (Pose), or a shape delivers what is not finite.
SUPERNORMAL_API Impact find_time_of_impact(const Shape& shape1, const Motion& motion1, const Shape& shape2, const Motion& motion2,
                                           double horizon, const Settings& settings = {}, const Vector3* first_normal = nullptr);

/// The same for a body (body 1) and the half-space plane_normal . x <= plane_offset (body 2), which stands still: plane_normal of
/// unit length, pointing out of the half-space, plane_offset in m. Every evaluation is one of the support function.
SUPERNORMAL_API Impact find_plane_time_of_impact(const Shape& shape, const Motion& motion, const Vector3& plane_normal,
                                                 double plane_offset, double horizon, const Settings& settings = {});

}  // namespace supernormal
