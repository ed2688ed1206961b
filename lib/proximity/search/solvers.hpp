// The three solvers of a gap function.
#pragma once

#include <span>

#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// Which local maximum of the gap function of overlapping bodies is wanted.
enum class WantedMaximum {
  Highest,  ///< the global maximum: the minimum translation distance (MTD)
  Tracked,  ///< the tracked maximum, to which the start leads; it is only left if it is clearly not the highest
};

// Each solver starts at the unit normal `start`. The answer is in body 1's frame.
Proximity solve_newton(GapFunction& gap, const Settings& settings, const Vector3& start);  // both shapes need a Hessian
Proximity solve_fixed_point(GapFunction& gap, const Settings& settings, const Vector3& start);
Proximity solve_hybrid(GapFunction& gap, const Settings& settings, const Vector3& start, WantedMaximum wanted);

/// The hybrid after a search in lanes that ended open. `best` is its best evaluation, and `cuts` are its other cuts.
Proximity resume_hybrid(GapFunction& gap, const Settings& settings, const GapJet& best, std::span<const Vector3> cuts,
                        WantedMaximum wanted);

}  // namespace supernormal
