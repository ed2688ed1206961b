// From the last evaluation of a solver to its answer.
#pragma once

#include "proximity/contact_point.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// The error that a solve may leave, m: Settings::tolerance in the pair's unit of length less what rounding takes of it, and not
/// less than rounding itself.
double absolute_tolerance(const GapFunction& gap, const Settings& settings);

/// m; no normal is higher than jet.n by more: s(m) <= m.d <= |d|. With a ball of this radius taken out of the difference of the
/// bodies (GapFunction::rolling_radius) the bound is tighter; of bodies apart, with or without the ball, it vanishes at the
/// maximum.
double optimality_gap_bound(const GapJet& jet, double rolling_radius);

/// The answer at jet.n, in body 1's frame. `model_error` (m) bounds what is left to the local maximum in exact arithmetic; the
/// answer adds rounding and takes optimality_gap_bound() where that is the better bound. It is known to
/// be global when the bodies, or what is left of them without the balls that roll inside them, are apart or touching.
Proximity answer(const GapFunction& gap, const Settings& settings, const GapJet& jet, double model_error, Status status);

/// Sets the contact of an answer `out` at `jet`, and its evaluations, of which contact_point() may make some more. A normal that
/// proves separation and no more, or nothing, has the point between its witness points.
void place_contact(GapFunction& gap, const Settings& settings, const GapJet& jet, Proximity& out,
                   std::span<const WitnessPair> beside = {});

}  // namespace supernormal
