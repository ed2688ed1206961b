// The three solvers of a gap function.
#pragma once

#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// Which local maximum of the gap function of overlapping bodies is wanted.
enum class Branch {
  Highest,  ///< the global one: the minimum translation distance (MTD)
  OfStart,  ///< the one that the start leads to, unless it is clearly not the highest: a contact does not jump without need
};

// Each solver starts at the unit normal `start` and answers in body 1's frame.
Proximity solve_newton(GapFunction& gap, const Settings& settings, const Vector3& start);  // both shapes need a Hessian
Proximity solve_fixed_point(GapFunction& gap, const Settings& settings, const Vector3& start);
Proximity solve_hybrid(GapFunction& gap, const Settings& settings, const Vector3& start, Branch branch);

}  // namespace supernormal
