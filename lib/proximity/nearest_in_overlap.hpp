// The point of two bodies' overlap that is nearest to where a contact is to act.
#pragma once

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// A place halfway between the tangent planes of an overlap, in body 1's frame.
struct Place {
  Vector3 point;  ///< m
  /// m; centres of the balls of Shape::rolling_radius that body 1 and body 2 hold there: those at boundary points beside which the
  /// place is, or their mean, whose ball the body holds, too.
  Vector3 centre1, centre2;
};

/// Whether it is known of both bodies, without an evaluation, that the place is within `near` (m) of them.
bool is_in_overlap(const GapFunction& gap, const Place& place, double near);

/// Moves the place to the nearest point of a body that is a ball there, no thicker than what rolls inside it: a small sphere or
/// capsule deep inside another body, which so keeps a contact on the line of its normal. Whether it is then in both.
bool move_into_ball(const GapFunction& gap, Place& place, double near);

/// The point of the overlap that is nearest to `place`, to a tenth of the way there; it is within `near` (m) of both bodies. All in
/// body 1's frame. GJK finds the points of both bodies that are nearest, and the place moves behind the tangent planes there, until
/// it is in both. `jet` is the answer's. Makes some four evaluations where the place is in both bodies already, at most 255, and no
/// more than `max_evaluations` since `gap` was made.
Vector3 nearest_in_overlap(GapFunction& gap, const GapJet& jet, Vector3 place, double near, int max_evaluations);

}  // namespace supernormal
