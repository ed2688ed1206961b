// The positions of two bodies at their impact, or at the end of the time step.
#pragma once

#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

// An overlap below this fraction of the size during the motion is no impact.
inline constexpr double kGraze = 0.01;

struct Meeting {
  double time = 0;      ///< s from now; 0: use the present poses
  Proximity there;      ///< of the bodies at that time, without rotation
  bool hits = false;    ///< whether they meet within the time step
  int evaluations = 0;  ///< evaluations of the gap function
};

/// The smallest half-extent of the two bodies, m. Bodies without thickness are ignored.
double smaller_thickness(const Shape& shape1, const Shape& shape2);

/// The body after `time` at its velocity, without rotation.
BodyAhead moved(const BodyAhead& body, double time);

/// Moves a manifold back by the displacements of the bodies, m, and each contact by their mean with the weight `share` of body 1.
/// Bodies that are apart by `gap` (m) do not overlap. The tangent planes there may say otherwise.
void take_back(ContactManifold& manifold, const Vector3& displacement1, const Vector3& displacement2, double share, double gap);

/// Finds the first time at which the bodies overlap by kGraze * `size` (m). If there is none within `time`, the result is the state
/// at `time`. Smaller overlaps are ignored, so a body that slides over two flush bodies does not hit the edge of the second.
///
/// No impact is missed. Without rotation the gap is convex in time: it is a maximum of linear functions, one for each normal. A
/// convex function lies above its tangents, so Newton's steps do not pass the first time at which it has a given value.
///
/// Returns `now` if the displacement is negligible, or if a pose leaves the valid range.
Meeting find_meeting(const BodyAhead& body1, const BodyAhead& body2, double time, double size, const Settings& settings,
                     const Proximity& now);

}  // namespace supernormal
