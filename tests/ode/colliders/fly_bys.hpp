// Random flights past bodies and surfaces, at a known clearance.
#pragma once

#include <array>

namespace supernormal::test {

/// What is flown past.
enum class Passed {
  Box,          ///< a dBox, fixed or free
  Ours,         ///< a superellipsoid, fixed or free
  ClosedMesh,   ///< a box of triangles
  Sheet,        ///< a level mesh with a border, from either side
  Heightfield,  ///< rough, from above
};

inline constexpr std::array kAllPassed = {Passed::Box, Passed::Ours, Passed::ClosedMesh, Passed::Sheet, Passed::Heightfield};

const char* name_of(Passed passed);

/// A body of 1 mm to 1 m goes straight on at 1 to 1000 m/s, without gravity, and looks ahead by steps of 1 to 50 ms. It is a
/// superellipsoid with exponents from 2 to 60, in any attitude; what it passes is 0.3 to 10 times as large. The smallest gap on its
/// way is `clearance`, in shares of the smallest half-extent of the two; with a single-precision ODE not below rounding. Negative:
/// they meet.
///
/// Returns what it loses of its velocity, or what a free body that it passes gets, as a share of its speed.
double fly_by(unsigned seed, Passed passed, double clearance);

}  // namespace supernormal::test
