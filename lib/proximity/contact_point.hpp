// One point for a contact force between two bodies.
#pragma once

#include <span>

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// A normal and the boundary points of two bodies that it has: of body 1, and from there to body 2, m, in body 1's frame.
struct WitnessPair {
  Vector3 n, point1, d;
};

/// The point halfway between the two tangent planes at which the contact acts, in body 1's frame: where the bodies would meet if
/// the gap were closed along the normal. Where that is beside a body in a deep overlap, the nearest point of both
/// (nearest_in_overlap.hpp). Symmetric under swapping the bodies.
///
/// Where the bodies are round, the witness points are near to each other and a formula has the point between them: to first order
/// the place where they meet when the normal turns (`contact_between`). On a flat face the boundary point of a normal is known to
/// no digit, and the radii of curvature at the normal say nothing of where the face ends. There the contact is a point that both
/// faces have in common, to within `tolerance` (m), the error that the normal's gap may have (lib/proximity/README.md). This is
/// asked of normals beside that of `jet`, until the two bodies' points meet: no evaluation where the formula does, about three
/// elsewhere, and no more than `max_evaluations` since `gap` was made. `beside` may have pairs that were evaluated that near to the
/// normal.
Vector3 contact_point(GapFunction& gap, const GapJet& jet, double tolerance, int max_evaluations,
                      std::span<const WitnessPair> beside = {});

/// The point between the witness points of `jet` that takes no evaluation. In the plane it is their mean weighted by the other
/// body's radius of curvature, p1 + A1 (A1 + A2)^-1 (p2 - p1), or by the smallest one of all its normals where a body has no
/// Hessian. It is the middle of the witness points in directions in which both radii are no more than rounding, or unknown. It is
/// never farther from a witness point than these are apart and the smaller body is long.
Vector3 contact_between(const GapFunction& gap, const GapJet& jet);

}  // namespace supernormal
