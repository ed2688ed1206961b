// The point of two bodies' overlap that is nearest to a contact's intended place.
#pragma once

#include "proximity/gap/stopping_rule.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// A place halfway between the tangent planes of an overlap, in body 1's frame.
struct Place {
  Vector3 point;  ///< m
  /// m; centres of balls with the radius Shape::rolling_radius inside body 1 and body 2. The balls touch the boundary at the points
  /// beside the place. For a mean of such points they are the mean centres: the body contains these balls, too.
  Vector3 centre1, centre2;
};

/// Whether the place is known to be within `near` (m) of both bodies, without an evaluation.
bool is_in_overlap(const GapFunction& gap, const Place& place, double near);

/// Moves the place to the nearest point of a body that is a ball there: it is no thicker than the ball that rolls inside it. So a
/// small sphere or capsule deep inside another body keeps a contact on the line of its normal. Returns whether the place is then in
/// both bodies.
bool move_into_ball(const GapFunction& gap, Place& place, double near);

/// The point of the overlap that is nearest to `place`, with an error of at most a tenth of the distance. It is within `near` (m)
/// of both bodies. All in body 1's frame. GJK finds the nearest points of both bodies. The place moves behind the tangent planes
/// there, until it is in both bodies. `jet` is the answer's. Takes about four evaluations if the place is in both bodies already,
/// at most 255, and no more than `rule` allows.
Vector3 nearest_in_overlap(GapFunction& gap, const GapJet& jet, Vector3 place, double near, const StoppingRule& rule);

}  // namespace supernormal
