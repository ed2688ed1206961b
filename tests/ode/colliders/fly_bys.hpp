// Random flights past bodies and surfaces, at a known clearance.
#pragma once

#include <array>

namespace supernormal::test {

/// The obstacle of a flight.
enum class Passed {
  Box,          ///< a dBox, fixed or free
  Ours,         ///< a superellipsoid, fixed or free
  ClosedMesh,   ///< a box of triangles
  Sheet,        ///< a level mesh with a border, from either side
  Heightfield,  ///< rough, passed from above
};

inline constexpr std::array kAllPassed = {Passed::Box, Passed::Ours, Passed::ClosedMesh, Passed::Sheet, Passed::Heightfield};

const char* name_of(Passed passed);

/// A body of 1 mm to 1 m flies in a straight line at 1 to 1000 m/s, without gravity, and looks ahead by steps of 1 to 50 ms. It is
/// a superellipsoid with exponents from 2 to 60, in any orientation. The obstacle is 0.3 to 10 times as large. The smallest gap on
/// the path is `clearance`, as a fraction of the smallest half-extent of the two, in single precision not below rounding. If it is
/// negative, they meet.
///
/// Returns the body's change of velocity, or the velocity of a free obstacle, as a fraction of the body's speed.
double fly_by(unsigned seed, Passed passed, double clearance);

}  // namespace supernormal::test
