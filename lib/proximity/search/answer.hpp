// From the last evaluation of a solver to its answer, and the answer for two balls.
#pragma once

#include "proximity/gap/stopping_rule.hpp"
#include "proximity/search/contact_point.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// m; an upper bound on max s - jet.s, because s(m) <= m.d <= |d|. With the ball of `rolling_radius` (m) taken out of the Minkowski
/// difference (GapFunction::rolling_radius) the bound is tighter. It vanishes at the maximum if the bodies without the ball are
/// apart.
double optimality_gap_bound(const GapJet& jet, double rolling_radius);

/// The answer at jet.n, in body 1's frame. `model_error` (m) bounds what is left to the local maximum in exact arithmetic. The
/// answer adds rounding, and takes optimality_gap_bound() if that is smaller. The answer is global if the bodies without their
/// rolling balls are apart, or if the bodies touch.
Proximity answer(const GapFunction& gap, const StoppingRule& rule, const GapJet& jet, double model_error, Status status);

/// Sets the contact of the answer `out` at `jet`, and its evaluations; contact_point() may add a few. A normal that only proves
/// separation, or proves nothing, gets the point between its witness points.
void place_contact(GapFunction& gap, const StoppingRule& rule, const GapJet& jet, Proximity& out,
                   std::span<const WitnessPair> beside = {});

/// An answer in body 1's frame, in the world's.
Proximity in_world(Proximity out, const Pose& pose1);

/// The answer for balls with these radii (m), in the world's frame. It takes no evaluation. Concentric balls have any common
/// normal: the first normal of the query, or an axis of the smaller ball.
Proximity find_between_balls(const ProximityQuery& pair, double radius1, double radius2, const Settings& settings);

}  // namespace supernormal
