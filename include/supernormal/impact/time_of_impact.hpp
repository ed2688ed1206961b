// When two moving bodies will meet.
#pragma once

#include "supernormal/impact/motion.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// s; the largest horizon.
inline constexpr double kMaxHorizon = 1e30;

/// How the search for an impact ended.
enum class ImpactStatus {
  Apart,         ///< no impact until the horizon: proved
  Hits,          ///< the gap comes within the tolerance at Impact::time, and not before: proved
  Overlapping,   ///< the bodies overlap by more than the tolerance at time 0
  NotConverged,  ///< a limit was reached, or a query has stalled; there is no impact before Impact::apart_until
  InvalidInput,  ///< a motion or a shape gave a number that is not finite, or a matrix is no rotation; the result holds no answer
};

/// The first impact of two moving bodies, or the proof that there is none.
struct Impact {
  ImpactStatus status = ImpactStatus::InvalidInput;  ///< how the search ended
  double time = 0;         ///< s; of the impact; 0 for an overlap; the horizon if there is none; apart_until if not converged
  double apart_until = 0;  ///< s; the gap is positive before this time, except if the bodies touch at time 0 and separate
  /// At `time`, in the frame of the poses: the normal from body 1 to body 2, the witness points and the contact. For bodies that
  /// stay apart it has Status::Apart, and its normal proves that the gap is at least `gap`.
  Proximity proximity;
  int evaluations = 0;  ///< of the gap function; for a body and a plane, of the support function

  /// Whether there is an impact, or an impact is not excluded.
  bool may_hit() const { return status != ImpactStatus::Apart; }
};

/// Finds the first time in [0, horizon] at which two bodies in steady motion meet. The tolerance is Settings::tolerance times the
/// smallest half-extent of the two, but at least the rounding error of the places on their way (lib/impact/README.md).
///
/// At the time of an impact the gap is in [0, tolerance], to rounding. A gap below half of the tolerance is an impact. No impact is
/// missed, however fast the bodies rotate: it is proved, and not sampled, that the bodies are apart at every time before. Bodies
/// that touch at time 0, with a gap of either sign within half of the tolerance, hit at 0 unless it is proved that they separate.
/// That is: they are apart at a later time, and until then they overlap by no more than the tolerance. The search then continues
/// from there.
///
/// `first_normal` (unit, in body 1's frame, or null) is the start of the first query: the normal of an earlier, similar pose.
///
/// `horizon` is in s, in [0, kMaxHorizon]. Of the settings, `tolerance`, `solver` and `max_evaluations` are used. The last limits
/// each query and the number of queries. Throws std::invalid_argument if one of these is out of range. Returns
/// ImpactStatus::InvalidInput if a number of a motion, or the angle of a rotation, exceeds kMaxMotion, if a matrix is not a
/// rotation (Pose), or if a value from a shape is not finite.
SUPERNORMAL_API Impact find_time_of_impact(const Shape& shape1, const Motion& motion1, const Shape& shape2, const Motion& motion2,
                                           double horizon, const Settings& settings = {}, const Vector3* first_normal = nullptr);

/// The same for a body (body 1) and the half-space plane_normal . x <= plane_offset (body 2), which is at rest. plane_normal has
/// unit length, to 1e-6, and points out of the half-space; plane_offset is in m. Evaluations are evaluations of the support
/// function. Also throws std::invalid_argument if plane_normal has another length.
SUPERNORMAL_API Impact find_plane_time_of_impact(const Shape& shape, const Motion& motion, const Vector3& plane_normal,
                                                 double plane_offset, double horizon, const Settings& settings = {});

}  // namespace supernormal
