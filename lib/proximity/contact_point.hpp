// One point for a contact force between two bodies.
#pragma once

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The point halfway between the two tangent planes at which the contact acts, in body 1's frame. In the plane it is the mean of
/// the witness points weighted by the other body's radius of curvature, p1 + A1 (A1 + A2)^-1 (p2 - p1): on a flat face the
/// boundary point of a normal is known to no digit, while the edge or corner that touches the face is exact
/// (lib/contact/README.md). It is the place where the points meet when the normal turns: to first order it does not depend on the
/// error of the normal. Symmetric under swapping the bodies. It is the middle of the witness points in directions in which both
/// radii of curvature are no more than rounding, or unknown. It is never farther from a witness point than these are apart and
/// the smaller body is long.
Vector3 contact_point(const GapFunction& gap, const GapJet& jet);

}  // namespace supernormal
