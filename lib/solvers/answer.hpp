// From the last evaluation of a solver to its answer.
#pragma once

#include "supernormal/solvers/gap_function.hpp"
#include "supernormal/solvers/proximity.hpp"

namespace supernormal {

/// The error that a solve may leave, m: Settings::tolerance in the pair's unit of length less what rounding takes of it, and not
/// less than rounding itself.
double absolute_tolerance(const GapFunction& gap, const Settings& settings);

/// The answer at jet.n, in body 1's frame. `model_error` (m) bounds what is left to the local maximum in exact arithmetic; the
/// answer adds rounding and takes the distance of the witness points where that is the better bound (bodies apart).
Proximity answer(const GapFunction& gap, const GapJet& jet, double model_error, Status status);

}  // namespace supernormal
