// The gap of a case, from a source other than the solvers.
#pragma once

#include "support/hard_cases/catalogue.hpp"

namespace supernormal::samples {

/// lower <= signed gap <= upper, up to the rounding of the support functions.
struct Reference {
  double lower = 0;  ///< m
  double upper = 0;  ///< m

  /// The distance of a gap from the interval, m; 0 inside.
  double distance(double gap) const;
};

/// The case's own gap, if it has one. Otherwise it is enclosed by branch and bound over all normals
/// (tests/proximity/collider_reference), to 1e-12 of the smallest half-extent or rounding.
Reference find_reference(const HardCase& one);

/// Encloses the gap by branch and bound, even if it is known. Stops after `max_evaluations` with a wider interval.
Reference enclose_gap(const HardCase& one, int max_evaluations = 1000000);

}  // namespace supernormal::samples
