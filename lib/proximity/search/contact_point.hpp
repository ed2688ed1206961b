// One point for a contact force between two bodies.
#pragma once

#include <span>

#include "proximity/gap/stopping_rule.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// A unit normal, body 1's boundary point with this normal, and the vector from there to body 2's boundary point. m, in body 1's
/// frame.
struct WitnessPair {
  Vector3 n, point1, d;
};

/// The point halfway between the two tangent planes where the contact acts, in body 1's frame: the bodies would meet there if the
/// gap were closed along the normal. If this point is outside a body, in a deep overlap, it is the nearest point of both bodies
/// (nearest_in_overlap.hpp). Symmetric under swapping the bodies.
///
/// For round bodies the witness points are near each other, and a formula gives the point between them. To first order this is
/// where they meet when the normal is tilted (`contact_between`). On a flat face no digit of a normal's boundary point is known,
/// and the radii of curvature do not contain the extent of the face. There the contact is a point that both faces have in common,
/// to within the tolerance of `rule`, the possible error of the gap (lib/proximity/README.md). Normals near jet.n are evaluated
/// until the points of the two bodies meet. This takes no evaluation where the formula applies and about three elsewhere, and no
/// more than `rule` allows. `beside` may contain pairs that were evaluated this near to the normal.
Vector3 contact_point(GapFunction& gap, const GapJet& jet, const StoppingRule& rule, std::span<const WitnessPair> beside = {});

/// The point between the witness points of `jet`, without an evaluation. In the plane it is their mean, each weighted by the other
/// body's radius of curvature: p1 + A1 (A1 + A2)^-1 (p2 - p1). If a body has no Hessian, the body's smallest radius of curvature
/// takes its place. It is the middle of the witness points in directions in which both radii are rounding errors, or unknown. Its
/// distance from a witness point is at most their distance plus the length of the smaller body.
Vector3 contact_between(const GapFunction& gap, const GapJet& jet);

}  // namespace supernormal
